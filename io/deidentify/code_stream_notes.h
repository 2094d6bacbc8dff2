#pragma once

#include <vector>

#include "io/dicom/fragments.h"

namespace volumen {

/// A range of bytes in a compressed picture that holds text or metadata and is not needed to decode it.
struct CodeStreamNote {
  std::uint64_t offset = 0;  ///< of the first byte, from the start of the file
  std::size_t length = 0;
  char blank = 0;  ///< the byte that overwrites each of them
};

/// Returns the notes of a JPEG, JPEG-LS or JPEG 2000 stream that begins in `fragment`: comments (COM) and
/// the segments of cameras and programs (APP1: Exif, XMP; APP13). Only segments before the first scan or
/// tile are searched. The result is empty if no such stream begins there or the stream is damaged.
std::vector<CodeStreamNote> codeStreamNotes(const RegularFile& file, dicom::Range fragment);

}  // namespace volumen
