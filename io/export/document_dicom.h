#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/export/content_items.h"
#include "io/study/derived_object.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

struct Study;

/// An image or another object that a document refers to.
struct DocumentPicture {
  std::string sopClassUid, sopInstanceUid, seriesUid;
  int frames = 0;       ///< number of frames; 0 if unknown
  bool isImage = true;  ///< false for presentation states, documents and contours
};

/// The study in which a document (SR, KO) is written, and the objects that the document may reference.
struct DocumentSource {
  std::string studyUid;
  DicomElements study;       ///< patient and study as elements, with texts in `characterSet`
  std::string characterSet;  ///< SpecificCharacterSet; may be empty
  int seriesNumber = 1;      ///< SeriesNumber for the new series, as of nextSeriesNumber()
  std::map<std::string, DocumentPicture> pictures;  ///< by SOPInstanceUID
};

/// Reads the headers of the instances that a document is about. The first one gives patient and study.
/// Returns an Error if an instance is missing, cannot be read, shares its UID with another picture, or is of
/// another study than the first.
Result<DocumentSource> readDocumentSource(const Study& study, std::span<const std::string> sopInstanceUids,
                                          const Progress& progress = {}, const CancelToken& cancel = {});

/// Returns an Error, a whole sentence, if the source lacks a picture or one of its frames.
Status checkPicture(const ReferencedPicture& picture, const DocumentSource& source);
/// Returns the content item that references a picture of the source. The picture must have passed
/// checkPicture().
ContentItem pictureItem(const char* relationship, const Code& name, const ReferencedPicture& picture,
                        const DocumentSource& source);

/// A document to write.
struct Document {
  const char* sopClassUid = "";
  const char* modality = "";  ///< "SR", "KO"
  std::string description{};  ///< SeriesDescription
  ContentItem content{};
  DicomElements more{};  ///< further elements that its class needs
};

/// Writes a document into the new file `path`, as a new series of the source's study with new UIDs. Its
/// evidence lists each referenced object once. Texts are in the character set of the source if it holds all
/// of them, else in ISO_IR 192. The file appears whole or not at all. Returns an Error that names `path` if
/// the file exists or cannot be written.
Status writeDocument(const Document& document, const DocumentSource& source, const std::string& path);

}  // namespace volumen
