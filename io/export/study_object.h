#pragma once

#include <string>
#include <vector>

#include "io/export/dicom_modules.h"
#include "io/export/dicom_source.h"

namespace volumen {

struct Study;

/// What a new object of a study says of itself. Text is UTF-8.
struct ObjectTags {
  std::string description{};   ///< SeriesDescription: shown in study lists
  int seriesNumber = 0;        ///< number of its series (nextSeriesNumber); 0: one above the source's
  std::string date{}, time{};  ///< creation date and time in DICOM format; if empty, now
};

/// Returns a series number that is above all of a study, as far as these are known, or the largest one that
/// is free.
int nextSeriesNumber(const Study& study, const std::string& studyUid);

/// Checks that an object can name a series and pictures of it by UIDs: those at `slices` (indices of
/// Series::files), or all. The Error: the series or a picture has no UID, or two files have the same one
/// that are no copies of each other.
Status checkNames(const Series& series, std::span<const std::size_t> slices = {});
/// Returns the sentence that two files that are no copies have the same SOPInstanceUID.
Error sameInstance(const std::string& a, const std::string& b);

/// A new object in the study of a series, alone in a new series. Its UIDs are random.
class StudyObject {
 public:
  /// Reads the headers of the pictures that the object is made of: all of a series, or those at `slices`
  /// (indices of Series::files). The Error: the series comes from no DICOM files, names no study, or its
  /// files have changed.
  static Result<StudyObject> of(const Series& series, const ObjectTags& tags, const Progress& progress,
                                const CancelToken& cancel, std::span<const std::size_t> slices = {});

  /// Puts patient and study as their file has them, the series, the equipment and `own` elements into a data
  /// set. All texts are in the character set of the file if it holds them, else in ISO_IR 192.
  void put(const char* sopClassUid, const char* modality, const DicomElements& own, DcmItem& into) const;

  const DicomSource& source() const { return source_; }
  /// Returns the first file's value of an element that is the same for all pictures; empty if it is missing.
  std::string valueOfSource(std::uint32_t tag) const { return valueOf(source_.file(0).elements, tag); }
  const ObjectTags& tags() const { return tags_; }  ///< with date and time
  /// Returns the pictures it is made of, each file once unless its frames were chosen. Pictures without
  /// UID are left out.
  std::vector<SourcePicture> pictures() const;

 private:
  StudyObject(const Series& series, ObjectTags tags, DicomSource source, bool areChosen);
  DicomElements elements(const char* sopClassUid, const char* modality) const;

  DicomSource source_;
  ObjectTags tags_;
  std::string studyUid_;
  bool areChosen_;
};

/// Returns the pictures of some slices of a source, each once; those without UID are left out.
std::vector<SourcePicture> picturesOf(const DicomSource& source, std::span<const int> slices);

/// Puts patient and study (texts in `characterSet`) and what was made for a new object (texts in UTF-8) into
/// a data set. All is in the character set if it holds all texts, else in ISO_IR 192.
void putInStudy(const DicomElements& ofStudy, const std::string& characterSet, const std::string& studyUid,
                const DicomElements& made, DcmItem& into);

/// Returns a text cut to a number of characters (16 in VR SH, 1024 in VR ST). Control characters other than
/// ends of lines become blanks.
std::string firstCharacters(const std::string& text, std::size_t most);

/// Returns a sequence of references to instances, each an item with class, instance and frame; nothing
/// without pictures.
DicomElements references(std::uint32_t sequence, std::span<const SourcePicture> pictures, int depth);

}  // namespace volumen
