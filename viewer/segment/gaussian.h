#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/segment/bit_window.h"

namespace volumen {

/// A Gaussian kernel sampled at voxels, cut at 4 standard deviations, with sum 1.
class GaussianKernel {
 public:
  /// Returns a kernel of `sigma` voxels along each axis; 0 is the identity.
  static GaussianKernel inVoxels(double sigma);
  /// Returns a separable kernel with its own sigma along each axis, in voxels.
  static GaussianKernel alongAxes(glm::dvec3 sigma);
  /// Returns a kernel of `sigmaMm` in patient space. It is separable if the grid axes are orthogonal. On
  /// sheared grids each row (y, z) has its own weights along i, cut and shifted to fit.
  static GaussianKernel inPatient(const VoxelGeometry& geometry, double sigmaMm);

  /// Returns the radius of the kernel along each axis, in voxels.
  glm::ivec3 reach() const { return reach_; }
  /// Returns the 1D weight of the next voxel along k. The kernel must be separable.
  float besideMiddle() const { return reach_.z > 0 ? alongJAndK_[1][1] : 0; }

 private:
  friend class GaussianBlock;
  // One row of the kernel along i, stored as its response to a step from 0 to 1 (running sums of the
  // weights).
  struct Row {
    int y, z;
    std::vector<float> step;
    float sum;
  };
  Row rowOf(int y, int z, const std::vector<double>& weights) const;

  glm::ivec3 reach_{0};
  std::vector<Row> rows_;                         // Separable kernels have only the row along i
  std::array<std::vector<float>, 2> alongJAndK_;  // Weights by distance; empty if not separable
};

/// Smooths masks block by block. Its buffers are reused from one block to the next.
class GaussianBlock {
 public:
  explicit GaussianBlock(const GaussianKernel& kernel) : kernel_(&kernel) {}

  /// Returns the smoothed bits of a block, i fastest; valid until the next call. `window` is the block grown
  /// by the kernel's reach.
  const float* smoothed(const BitWindow& window);

 private:
  void smoothRows(const BitWindow& window, glm::ivec3 size);
  void smoothSeparably(const BitWindow& window, glm::ivec3 size);

  const GaussianKernel* kernel_;
  std::vector<float> alongI_, alongJ_, values_;
};

/// Returns the block edge along j and k at which the overlap of blocks costs little for this reach.
int blockEdgeFor(glm::ivec3 reach);

}  // namespace volumen
