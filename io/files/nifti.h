#pragma once

#include <string>

#include "io/files/image_header.h"

namespace volumen {

/// Whether `head`, the first decompressed bytes of a file, is a NIfTI or Analyze header.
bool isNiftiHead(const std::string& head);

/// The first `count` bytes of a file; of what is inside where it is compressed with gzip.
Result<std::string> readDecompressedHead(const std::string& path, std::size_t count);

/// The volumes of a NIfTI-1 or NIfTI-2 file or pair (.hdr and .img), nifti1.h and nifti2.h. Geometry by
/// sform, else qform, else pixdim as nibabel places it (centred, first axis to the left). Refused with a
/// reason: colour pictures, complex numbers, CIFTI.
Result<ImageHeader> readNiftiHeader(const std::string& path);

}  // namespace volumen
