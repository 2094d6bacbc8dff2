#pragma once

#include "io/dicom/decode.h"

namespace volumen::dicom {

/// Makes the tiles of a Siemens mosaic its frames, each with its place by the CSA header; what is no mosaic
/// is left as it is. Where number, normal or distance of the slices are not known, `header.notVolume` says
/// so.
void splitMosaic(const DataSet& data, FileHeader& header);

/// The format of the whole picture that holds tiles of `tile`.
PixelFormat wholeMosaic(PixelFormat tile, const Mosaic& mosaic);

/// Tile `n` (from 0) of a decoded mosaic; `format` is that of the tile.
DecodedFrame tileOf(const DecodedFrame& whole, int n, const PixelFormat& format, const Mosaic& mosaic);

}  // namespace volumen::dicom
