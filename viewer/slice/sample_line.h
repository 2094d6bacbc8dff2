#pragma once

#include <cmath>
#include <cstdint>

#include "viewer/slice/plane.h"

namespace volumen {

/// Rounds positions to 2^-24 voxels, so that points on a voxel centre, a midpoint or a box face hit it
/// exactly. |x| must be below 2^27.
constexpr double positionUnits = 0x1.8p28;
inline double roundedPosition(double x) { return (x + positionUnits) - positionUnits; }

/// Evenly spaced points in voxel space.
struct SampleLine {
  glm::dvec3 start{0}, step{0};

  /// Returns component a of the n-th point.
  double at(std::int64_t n, int a) const { return roundedPosition(double(n) * step[a] + start[a]); }
};

/// The points [first, last).
struct SampleRange {
  std::int64_t first = 0, last = 0;
};

/// Returns the points of `range` inside the box -1/2 .. size - 1/2, faces included.
SampleRange insideBox(const SampleLine& line, SampleRange range, glm::ivec3 size);

/// Number of values beyond the last that a line kernel may write.
constexpr int lineSlack = 64;

/// Writes interpolated stored values at the points of `range`, which must lie in the box. `stored` has i
/// fastest.
using LineKernel = void (*)(const void* stored, glm::ivec3 size, const SampleLine& line, SampleRange range,
                            float* values);

/// Returns the kernel for this sample type on this CPU.
LineKernel chooseLineKernel(const VoxelValues& stored, Interpolation interpolation);

/// Returns the linear kernel for points on voxel positions along `axis`, which reads half the voxels. For
/// axis 2 the values equal those of chooseLineKernel() bit for bit.
LineKernel chooseLayerKernel(const VoxelValues& stored, int axis);

/// Returns the line kernel for a volume. In a volume of one slice every point lies on that slice.
LineKernel chooseKernel(const Volume& volume, Interpolation interpolation);

}  // namespace volumen
