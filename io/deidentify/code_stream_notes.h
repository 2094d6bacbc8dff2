#pragma once

#include <vector>

#include "io/dicom/fragments.h"

namespace volumen {

/// Bytes of a compressed picture that say something about it and are not needed to decode it.
struct CodeStreamNote {
  std::uint64_t offset = 0;  ///< in the file
  std::size_t length = 0;
  char blank = 0;  ///< what to put in their place
};

/// Returns the comments (COM) before the first scan of a JPEG, JPEG-LS or JPEG 2000 stream that begins in
/// `fragment`, and what cameras and programs write beside them (APP1: Exif, XMP; APP13). The result is empty
/// if the fragment begins no such stream or is damaged.
std::vector<CodeStreamNote> codeStreamNotes(const RegularFile& file, dicom::Range fragment);

}  // namespace volumen
