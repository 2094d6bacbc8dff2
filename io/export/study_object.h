#pragma once

#include <string>
#include <vector>

#include "io/export/dicom_modules.h"
#include "io/export/dicom_source.h"

namespace volumen {

struct Study;

/// Attributes of a new object of a study. Text is UTF-8.
struct ObjectTags {
  std::string description{};   ///< SeriesDescription: shown in study lists
  int seriesNumber = 0;        ///< SeriesNumber (nextSeriesNumber()); if 0, one above the source's
  std::string date{}, time{};  ///< creation date and time in DICOM format; if empty, now
};

/// Returns a series number above all known ones of a study. If the highest is taken, returns the largest
/// free one.
int nextSeriesNumber(const Study& study, const std::string& studyUid);

/// Checks that an object can reference a series and its pictures by UIDs: those at `slices` (indices of
/// Series::files), or all. Returns an Error if the series or a picture has no UID, or if two files that are
/// no copies of each other share one.
Status checkNames(const Series& series, std::span<const std::size_t> slices = {});
/// Returns an Error that says that files `a` and `b` have the same SOPInstanceUID but are no copies.
Error sameInstance(const std::string& a, const std::string& b);

/// A new object in the study of a series. It is alone in a new series and has random UIDs.
class StudyObject {
 public:
  /// Reads the headers of the pictures that the object is made of: all of a series, or those at `slices`
  /// (indices of Series::files). Returns an Error if the series is not from DICOM files or names no study,
  /// or if its files have changed.
  static Result<StudyObject> of(const Series& series, const ObjectTags& tags, const Progress& progress,
                                const CancelToken& cancel, std::span<const std::size_t> slices = {});

  /// Puts patient, study, series, equipment and the `own` elements into a data set. Patient and study are
  /// those of the first file. Texts are in its character set if it holds all of them, else in ISO_IR 192.
  void put(const char* sopClassUid, const char* modality, const DicomElements& own, DcmItem& into) const;

  const DicomSource& source() const { return source_; }
  /// Returns the first file's value of an element; empty if it is missing. Meant for elements that are equal
  /// in all pictures.
  std::string valueOfSource(std::uint32_t tag) const { return valueOf(source_.file(0).elements, tag); }
  const ObjectTags& tags() const { return tags_; }  ///< has date, time and series number filled in
  /// Returns the pictures that the object is made of, without those that have no UID. A file counts once,
  /// unless some of its frames were chosen.
  std::vector<SourcePicture> pictures() const;

 private:
  StudyObject(const Series& series, ObjectTags tags, DicomSource source, bool areChosen);
  DicomElements elements(const char* sopClassUid, const char* modality) const;

  DicomSource source_;
  ObjectTags tags_;
  std::string studyUid_;
  bool areChosen_;
};

/// Returns the pictures of some slices of a source, each once, without those that have no UID.
std::vector<SourcePicture> picturesOf(const DicomSource& source, std::span<const int> slices);

/// Puts two groups of elements into a data set: `ofStudy` (patient and study, with texts in `characterSet`)
/// and `made` (of the new object, with texts in UTF-8). All texts are written in `characterSet` if it holds
/// all of them, else in ISO_IR 192.
void putInStudy(const DicomElements& ofStudy, const std::string& characterSet, const std::string& studyUid,
                const DicomElements& made, DcmItem& into);

/// Returns the first `most` characters of a UTF-8 text. Control characters other than line ends become
/// blanks.
std::string firstCharacters(const std::string& text, std::size_t most);

/// Returns a sequence whose items reference pictures by class, instance and frame. `depth` is the nesting
/// level of the sequence. Without pictures the result is empty.
DicomElements references(std::uint32_t sequence, std::span<const SourcePicture> pictures, int depth);

}  // namespace volumen
