#pragma once

#include "io/deidentify/file_parts.h"
#include "io/dicom/scanned_file.h"

namespace volumen {

/// Says what copied pixels still hold.
struct CopiedPixels {
  bool keepOverlays = false;  ///< true if overlays lie in bits that could not be cleared
};

/// Adds the pixel data of a file to `parts`, without what hides beside the pixels. Overlays in unused bits
/// and bytes behind the last pixel become zeros. Notes in code streams are overwritten (codeStreamNotes()).
/// The pixels and all lengths stay. Returns an Error without the file's name if the pixel data are damaged.
Result<CopiedPixels> addPixels(const dicom::ScannedFile& s, const RegularFile& file, FileParts& parts);

}  // namespace volumen
