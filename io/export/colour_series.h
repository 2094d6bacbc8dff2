#pragma once

#include <functional>

#include "io/export/secondary_capture.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Slices in colour: where they lie and what they are made of.
struct ColourSlices {
  VoxelGeometry geometry;
  double thicknessMm = 0;                 ///< SliceThickness
  std::vector<std::vector<int>> sources;  ///< for each slice, the slices of its series that it shows
  std::vector<std::vector<SourcePicture>>
      overlaid;  ///< for each slice, pictures of another series that it shows
};

/// Returns slice k as 3 bytes a pixel, first row on top.
using ColourSlice = std::function<Result<std::vector<std::uint8_t>>(int k)>;

/// Writes slices in colour as a new series of the study of `series` into a new folder, whole or not at all: a
/// Secondary Capture (RGB, 8 bits) a slice, with its position, spacing and the frame of reference of the
/// series. The Error: the series comes from no DICOM files, the geometry is not calibrated, the folder cannot
/// be made, cancelled, or that of `slice`.
Status writeColourSeries(const Series& series, const CaptureTags& tags, const ColourSlices& slices,
                         const ColourSlice& slice, const std::string& folder, const Progress& progress = {},
                         const CancelToken& cancel = {});

}  // namespace volumen
