#pragma once

#include "io/dicom/scanned_file.h"

class DcmDataset;

namespace volumen::dicom {

/// Decodes a file that is compressed as JPEG 2000 or HTJ2K, as PixelSource does, and puts the pixels into its
/// data set in place of the fragments. The attributes of the data set then describe these pixels. `scanned`
/// is the file after scan(). The Error, without the file's name and full stop: the pixels cannot be decoded.
Status putNativePixels(const RegularFile& file, const ScannedFile& scanned, DcmDataset& data);

}  // namespace volumen::dicom
