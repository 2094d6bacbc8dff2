#pragma once

#include "io/export/dicom_series.h"
#include "io/export/stack_volume.h"
#include "viewer/slice/grid_values.h"

namespace volumen {

/// The grid of another series, to resample a series on.
struct OtherGrid {
  PlacedGrid placed;
  SeriesIdentity series;  ///< the other series
  std::string relation;   ///< how its space and that of the source relate, in words; empty: they are one
};

/// Resamples a volume on the grid of another series (resampleGridSlice). The Error: one of the two is not
/// calibrated, cancelled, or that of volumeOfSlices().
Result<StackVolume> resampleOnGrid(const Volume& volume, const OtherGrid& grid, const Progress& progress = {},
                                   const CancelToken& cancel = {});

/// Returns the tags of a loaded series on the grid of another one as a new series of its study: those of the
/// source (readDicomTags) with the other's frame of reference, a description of their own and the source
/// images of each slice.
DicomSeriesTags gridTags(DicomSeriesTags ofSource, const Loaded& loaded, const OtherGrid& grid,
                         int seriesNumber);

}  // namespace volumen
