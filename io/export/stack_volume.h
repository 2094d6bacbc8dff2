#pragma once

#include <functional>
#include <optional>

#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// A volume resampled slice by slice.
struct StackVolume {
  VolumePtr volume;
  std::optional<float> outside;  ///< value of the pixels outside of the source; empty: there are none
};

/// Appends the values of slice n, row by row, NaN outside of the source.
using AppendSlice = std::function<Status(int n, std::vector<float>& values)>;

/// Makes a volume on `geometry` of slices of `source`, with its attributes. Pixels outside of it get the
/// lowest value of its padding, or if it has none, the lowest of all pixels. The Error: no pixel lies in the
/// source, memory is too small, or that of `append`.
Result<StackVolume> volumeOfSlices(const Volume& source, const VoxelGeometry& geometry,
                                   const AppendSlice& append, const Progress& progress);

/// Returns the slices of a source (indices of Series::files) that are shown at points from `low` to `high`
/// along the k of its drawn voxels; none if all points lie outside.
std::vector<int> sourcesBetween(const Loaded& loaded, double low, double high, Interpolation interpolation);

/// Returns "linear", "nearest neighbour" or "cubic".
const char* wordsOf(Interpolation interpolation);

}  // namespace volumen
