#pragma once

#include "io/dicom/decode.h"

namespace volumen::dicom {

/// Turns the tiles of a Siemens mosaic into its frames, with positions from the CSA header. Other pictures
/// stay unchanged. `header.notVolume` gives the reason if the number, normal or distance of the slices is
/// unknown.
void splitMosaic(const DataSet& data, FileHeader& header);

/// Returns the format of the whole picture that holds tiles of format `tile`.
PixelFormat wholeMosaic(PixelFormat tile, const Mosaic& mosaic);

/// Returns tile `n` (from 0) of a decoded mosaic. `format` is that of the tile.
DecodedFrame tileOf(const DecodedFrame& whole, int n, const PixelFormat& format, const Mosaic& mosaic);

}  // namespace volumen::dicom
