#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/segment/bit_window.h"

namespace volumen {

/// A Gaussian, sampled at voxels, cut at 4 standard deviations, of sum 1.
class GaussianKernel {
 public:
  /// Of `sigma` voxels along each axis; 0: the voxel alone.
  static GaussianKernel inVoxels(double sigma);
  /// Of so many voxels along each of them, a product of three.
  static GaussianKernel alongAxes(glm::dvec3 sigma);
  /// Of sigmaMm in patient space. Where the axes of the grid are orthogonal it is a product of three along
  /// them; on sheared grids each row (y, z) of it has its own along i, cut and shifted as the grid demands.
  static GaussianKernel inPatient(const VoxelGeometry& geometry, double sigmaMm);

  /// How many voxels it reaches along each axis.
  glm::ivec3 reach() const { return reach_; }
  /// The weight of the next voxel along k by that axis alone; of a product of three.
  float besideMiddle() const { return reach_.z > 0 ? alongJAndK_[1][1] : 0; }

 private:
  friend class GaussianBlock;
  // A row of the kernel along i, as what becomes of a step from 0 to 1 (sums of its weights).
  struct Row {
    int y, z;
    std::vector<float> step;
    float sum;
  };
  Row rowOf(int y, int z, const std::vector<double>& weights) const;

  glm::ivec3 reach_{0};
  std::vector<Row> rows_;                         // separable: the one along i
  std::array<std::vector<float>, 2> alongJAndK_;  // weights by distance; empty where it is not separable
};

/// Smooths masks block by block; the memory for it is kept from one block to the next.
class GaussianBlock {
 public:
  explicit GaussianBlock(const GaussianKernel& kernel) : kernel_(&kernel) {}

  /// The smoothed bits of a block, i fastest: `window` is it and the kernel's reach around it. To the next
  /// call.
  const float* smoothed(const BitWindow& window);

 private:
  void smoothRows(const BitWindow& window, glm::ivec3 size);
  void smoothSeparably(const BitWindow& window, glm::ivec3 size);

  const GaussianKernel* kernel_;
  std::vector<float> alongI_, alongJ_, values_;
};

/// The edge of blocks along j and k for which a kernel's reach costs little.
int blockEdgeFor(glm::ivec3 reach);

}  // namespace volumen
