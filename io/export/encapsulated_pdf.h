#pragma once

#include <string_view>

#include "io/export/study_object.h"

namespace volumen {

/// Attributes of a written Encapsulated PDF.
struct PdfTags : ObjectTags {
  std::string title = "Report";  ///< DocumentTitle
  bool hasNames = true;          ///< true if its pages identify the patient
};

/// Returns true if the header of a PDF file is in the first 1024 bytes.
bool isPdf(std::string_view bytes);

/// Writes the bytes of a PDF file as an Encapsulated PDF (PS3.3 A.45.1) into a new file, in the study of
/// `series`. Returns an Error if `path` exists or cannot be written, if the series is not from DICOM files,
/// or if the export was cancelled. Also returns an Error if the bytes are no PDF or exceed the 4 GB that a
/// DICOM file holds.
Status writeEncapsulatedPdf(std::string_view pdf, const Series& series, const PdfTags& tags,
                            const std::string& path, const Progress& progress = {},
                            const CancelToken& cancel = {});

}  // namespace volumen
