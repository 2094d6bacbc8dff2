#pragma once

#include "io/export/dicom_series.h"
#include "io/export/stack_volume.h"
#include "viewer/slice/plane.h"
#include "viewer/slice/smooth_curve.h"

namespace volumen {

/// Planes at one distance: parallel ones along their normal, or those across a curve.
struct SliceStack {
  SlicePlane first;
  int count = 1;
  double distanceMm = 1;             ///< from plane to plane
  std::vector<SlicePlane> across{};  ///< all planes, if they are not parallel
  std::string curve{};               ///< name of the curve that they lie across; may be empty

  /// Returns plane n.
  SlicePlane plane(int n) const;
};

/// Returns the planes like `plane` at this distance (mm, above 0) that cover a volume along their normal,
/// centred on it. The Error: they are more than a series can number.
Result<SliceStack> stackThrough(const VoxelGeometry& geometry, SlicePlane plane, double distanceMm);

/// Returns the planes like `like` at this distance (mm, above 0) across a curve (planesAcross()). The Error:
/// the curve is longer than 10 m, or they are more than a series can number.
Result<SliceStack> stackAlong(const SmoothCurve& curve, const std::string& name, const SlicePlane& like,
                              double distanceMm);

/// Returns the grid whose slices are the planes of a stack, as if its curve were straight.
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
