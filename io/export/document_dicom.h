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
  int frames = 0;       ///< number of frames; 0: unknown
  bool isImage = true;  ///< false for presentation states, documents and contours
};

/// The study that a document (SR, KO) is written for, and the objects that it may refer to.
struct DocumentSource {
  std::string studyUid;
  DicomElements study;       ///< patient and study as elements, with texts in `characterSet`
  std::string characterSet;  ///< SpecificCharacterSet; may be empty
  int seriesNumber = 1;      ///< one above all of the study's
  std::map<std::string, DocumentPicture> pictures;  ///< by SOPInstanceUID
};

/// Reads what documents about these instances take from their study: the headers of the instances, of which
/// the first one gives patient and study. The Error: an instance is missing, cannot be read, shares its UID
/// with another picture, or is of another study than the first.
Result<DocumentSource> readDocumentSource(const Study& study, std::span<const std::string> sopInstanceUids,
                                          const Progress& progress = {}, const CancelToken& cancel = {});

/// Returns a sentence if the source lacks a picture or one of its frames.
Status checkPicture(const ReferencedPicture& picture, const DocumentSource& source);
/// Returns the content item of a picture, which the source must hold.
ContentItem pictureItem(const char* relationship, const Code& name, const ReferencedPicture& picture,
                        const DocumentSource& source);

/// A document to be written.
struct Document {
  const char* sopClassUid = "";
  const char* modality = "";  ///< "SR", "KO"
  std::string description{};  ///< SeriesDescription
  ContentItem content{};
  DicomElements more{};  ///< further elements of its class
};

/// Writes a document into `path`, as a new series of the source's study with new UIDs. Its evidence lists
/// each object that the content refers to once. The character set is that of the source if it holds all
/// texts, else ISO_IR 192. The file appears whole or not at all and replaces none; the Error names it.
Status writeDocument(const Document& document, const DocumentSource& source, const std::string& path);

}  // namespace volumen
