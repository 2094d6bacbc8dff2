#pragma once

#include "io/dicom/scanned_file.h"

class DcmDataset;

namespace volumen::dicom {

/// Puts the decoded pixels of a file that is compressed as JPEG 2000 or HTJ2K into its data set, as
/// PixelSource reads them, in place of the fragments. Its attributes then describe native pixels. `scanned`
/// is the file after scan(). The Error, without the file's name and full stop: the pixels cannot be decoded.
Status putNativePixels(const RegularFile& file, const ScannedFile& scanned, DcmDataset& data);

}  // namespace volumen::dicom
