#pragma once

#include <string_view>

#include "io/export/study_object.h"

namespace volumen {

/// What an encapsulated PDF says of itself.
struct PdfTags : ObjectTags {
  std::string title = "Report";  ///< title of the document
  bool hasNames = true;          ///< its pages tell who the patient is
};

/// Returns whether bytes are those of a PDF file.
bool isPdf(std::string_view bytes);

/// Writes the bytes of a PDF file as an Encapsulated PDF (PS3.3 A.45.1) into a new file of the study of its
/// series. The Error: the path exists or cannot be written, the series is not from DICOM files, the bytes are
/// no PDF or more than the 4 GB that a DICOM file holds, or the export was cancelled.
Status writeEncapsulatedPdf(std::string_view pdf, const Series& series, const PdfTags& tags,
                            const std::string& path, const Progress& progress = {},
                            const CancelToken& cancel = {});

}  // namespace volumen
