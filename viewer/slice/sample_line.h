#pragma once

#include <cmath>
#include <cstdint>

#include "viewer/slice/plane.h"

namespace volumen {

/// Positions are rounded to 2^-24 voxels: what the rounding of doubles leaves of a voxel's centre, of the
/// middle between two or of the box's face is that place itself. |x| below 2^27.
constexpr double positionUnits = 0x1.8p28;
inline double roundedPosition(double x) { return (x + positionUnits) - positionUnits; }

/// Evenly spaced points of voxel space.
struct SampleLine {
  glm::dvec3 start{0}, step{0};

  /// Component a of the n-th point.
  double at(std::int64_t n, int a) const { return roundedPosition(double(n) * step[a] + start[a]); }
};

/// The points `first` up to, not including, `last`.
struct SampleRange {
  std::int64_t first = 0, last = 0;
};

/// Those of the points in `range` that lie in the box -1/2 .. size - 1/2, faces included.
SampleRange insideBox(const SampleLine& line, SampleRange range, glm::ivec3 size);

/// How many values beyond the last a line kernel may write.
constexpr int lineSlack = 64;

/// Writes the stored values, interpolated, at points of `range`, which lie in the box. `stored`: the samples,
/// i fastest.
using LineKernel = void (*)(const void* stored, glm::ivec3 size, const SampleLine& line, SampleRange range,
                            float* values);

/// The kernel for samples of this type, on this CPU.
LineKernel chooseLineKernel(const VoxelValues& stored, Interpolation interpolation);

/// The linear one for points that lie on voxels along `axis`: half the voxels are read. Where `axis` is 2 the
/// values are those of the kernel above, bit for bit.
LineKernel chooseLayerKernel(const VoxelValues& stored, int axis);

}  // namespace volumen
