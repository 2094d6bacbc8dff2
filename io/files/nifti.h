#pragma once

#include <string>

#include "io/files/image_header.h"

namespace volumen {

/// True if `head`, the first decompressed bytes of a file, is a NIfTI or Analyze header.
bool isNiftiHead(const std::string& head);

/// Returns the first `count` bytes of a file, decompressed if it is gzip.
Result<std::string> readDecompressedHead(const std::string& path, std::size_t count);

/// Reads the header of a NIfTI-1 or NIfTI-2 file or pair (.hdr and .img); see nifti1.h and nifti2.h. Geometry
/// comes from the sform, else the qform, else pixdim as nibabel places it (centred, first axis to the left).
/// The Error gives a reason: colour images, complex numbers, CIFTI.
Result<ImageHeader> readNiftiHeader(const std::string& path);

}  // namespace volumen
