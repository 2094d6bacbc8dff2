#pragma once

#include "io/export/dicom_series.h"
#include "io/export/stack_volume.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// Parallel planes at one distance, along their normal.
struct SliceStack {
  SlicePlane first;
  int count = 1;
  double distanceMm = 1;  ///< from plane to plane

  /// Returns plane n.
  SlicePlane plane(int n) const;
};

/// Returns the planes like `plane` at this distance (mm, above 0) that cover a volume along their normal,
/// centred on it. The Error: they are more than a series can number.
Result<SliceStack> stackThrough(const VoxelGeometry& geometry, SlicePlane plane, double distanceMm);

/// Returns the grid whose slices are the planes of a stack.
VoxelGeometry geometryOf(const SliceStack& stack);
/// Returns the slices of a source (indices of Series::files) whose voxels the samples of a plane lie on or
/// between.
std::vector<int> sourcesOf(const SlicePlane& plane, const Loaded& loaded);

/// Resamples a volume on each plane of a stack (resampleSlice). The Error: the volume is not calibrated,
/// cancelled, or that of volumeOfSlices().
Result<StackVolume> resampleStack(const Volume& volume, const SliceStack& stack,
                                  const Progress& progress = {}, const CancelToken& cancel = {});

/// Returns what the slices are in words: "Coronal, slabs of 10 mm (max)".
std::string wordsOf(const SliceStack& stack);

/// Returns the tags of a stack through a loaded series as a new series of its study: those of the source
/// (readDicomTags) with a description of their own and the source images of each slice.
DicomSeriesTags stackTags(DicomSeriesTags ofSource, const Loaded& loaded, const SliceStack& stack,
                          int seriesNumber);

}  // namespace volumen
