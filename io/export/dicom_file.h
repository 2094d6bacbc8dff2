#pragma once

#include <string>

#include "io/files/output_file.h"

class DcmFileFormat;

namespace volumen {

/// Writes a DICOM file (Explicit VR Little Endian) to `out`, which the caller commits. The Error names
/// `path`.
Status writeDicomFile(DcmFileFormat& file, OutputFile& out, const std::string& path);

}  // namespace volumen
