#pragma once

#include "io/deidentify/file_parts.h"
#include "io/dicom/scanned_file.h"

namespace volumen {

/// What is still in pixels that were copied.
struct CopiedPixels {
  bool keepOverlays = false;  ///< overlays lie in bits that could not be cleared
};

/// Adds the pixel data of a file to `parts`, without what hides beside the pixels: overlays in unused bits
/// and bytes behind the last pixel become zeros, comments of code streams blanks (codeStreamNotes()). The
/// pixels and all lengths stay. The Error, without the file's name: the pixel data are damaged.
Result<CopiedPixels> addPixels(const dicom::ScannedFile& s, const RegularFile& file, FileParts& parts);

}  // namespace volumen
