#include "viewer/segment/gaussian.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumen {

namespace {

constexpr double cutAt = 4;       // standard deviations
constexpr double noShear = 1e-3;  // largest cosine between axes that count as orthogonal

// Returns the weights for -reach .. reach, with sum 1.
std::vector<double> gaussianWeights(double sigma) {
  const int reach = int(cutAt * sigma);
  std::vector<double> weights;
  double sum = 0;
  for (int n = -reach; n <= reach; ++n) {
    weights.push_back(n == 0 ? 1 : std::exp(-0.5 * n * n / (sigma * sigma)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::vector<float> byDistance(const std::vector<double>& weights) {
  return {weights.begin() + std::ptrdiff_t(weights.size() / 2), weights.end()};
}

bool isOrthogonal(const glm::dmat3& step) {
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    if (std::abs(glm::dot(step[a], step[b])) > noShear * glm::length(step[a]) * glm::length(step[b]))
      return false;
  }
  return true;
}

// Adds a filtered row of bits: each step up or down in the row adds or subtracts the step response.
void addFilteredRow(std::span<const std::uint64_t> bits, int reach, const float* step, float sum, float* to) {
  if (bits[0] & 1)
    for (int i = 0; i < blockWidth; ++i) to[i] += sum;
  const int count = blockWidth + 2 * reach;
  std::uint64_t before = bits[0] & 1;
  for (int n = 0; n < int(bits.size()); ++n) {
    const std::uint64_t word = bits[std::size_t(n)];
    for (std::uint64_t steps = word ^ (word << 1 | before); steps; steps &= steps - 1) {
      const int bit = std::countr_zero(steps), at = 64 * n + bit;
      if (at >= count) break;
      const float* const from = step + (blockWidth - 1 + 2 * reach - at);
      if (word >> bit & 1)
        for (int i = 0; i < blockWidth; ++i) to[i] += from[i];
      else
        for (int i = 0; i < blockWidth; ++i) to[i] -= from[i];
    }
    before = word >> 63;
  }
}

// Filters a row of a block across rows. `from` is the middle row; neighbours are `stride` apart.
void filterAcross(const std::vector<float>& weights, const float* from, std::ptrdiff_t stride, float* to) {
  for (int i = 0; i < blockWidth; ++i) to[i] = weights[0] * from[i];
  for (std::size_t n = 1; n < weights.size(); ++n) {
    const float weight = weights[n];
    const float *const before = from - std::ptrdiff_t(n) * stride, *const behind =
                                                                       from + std::ptrdiff_t(n) * stride;
    for (int i = 0; i < blockWidth; ++i) to[i] += weight * (before[i] + behind[i]);
  }
}

}  // namespace

// `weights` are those for -reach .. reach along i. The step response is that of a row that is 1 from voxel 0
// on, at -(blockWidth - 1 + reach) .. blockWidth - 1 + reach.
GaussianKernel::Row GaussianKernel::rowOf(int y, int z, const std::vector<double>& weights) const {
  Row row{y, z, {}, 0};
  double sum = 0;
  const int far = blockWidth - 1 + reach_.x;
  for (int at = -far; at <= far; ++at) {
    if (std::abs(at) <= reach_.x) sum += weights[std::size_t(at + reach_.x)];
    row.step.push_back(float(sum));
  }
  row.sum = float(sum);
  return row;
}

GaussianKernel GaussianKernel::inVoxels(double sigma) { return alongAxes(glm::dvec3(sigma)); }

GaussianKernel GaussianKernel::alongAxes(glm::dvec3 sigma) {
  GaussianKernel kernel;
  std::array<std::vector<double>, 3> weights;
  for (int a = 0; a < 3; ++a) {
    weights[a] = gaussianWeights(sigma[a]);
    kernel.reach_[a] = int(weights[a].size() / 2);
  }
  kernel.rows_.push_back(kernel.rowOf(0, 0, weights[0]));
  kernel.alongJAndK_ = {byDistance(weights[1]), byDistance(weights[2])};
  return kernel;
}

GaussianKernel GaussianKernel::inPatient(const VoxelGeometry& geometry, double sigmaMm) {
  const glm::dmat3& step = geometry.patientFromVoxelStep;
  if (isOrthogonal(step)) return alongAxes(sigmaMm / geometry.spacing());
  GaussianKernel kernel;
  // A ball of 4 standard deviations reaches along an axis as far as the length of that row of L^-1.
  const glm::dmat3 back = glm::transpose(geometry.voxelFromPatientStep());
  for (int a = 0; a < 3; ++a) kernel.reach_[a] = int(cutAt * sigmaMm * glm::length(back[a]));
  const glm::ivec3 r = kernel.reach_;
  const double farthest = cutAt * sigmaMm;
  std::vector<double> weights;
  double sum = 0;
  for (int z = -r.z; z <= r.z; ++z)
    for (int y = -r.y; y <= r.y; ++y)
      for (int x = -r.x; x <= r.x; ++x) {
        const double mm = glm::length(step * glm::dvec3(x, y, z));
        weights.push_back(mm > farthest ? 0 : mm == 0 ? 1 : std::exp(-0.5 * mm * mm / (sigmaMm * sigmaMm)));
        sum += weights.back();
      }
  for (double& weight : weights) weight /= sum;
  auto at = weights.begin();
  for (int z = -r.z; z <= r.z; ++z)
    for (int y = -r.y; y <= r.y; ++y, at += 2 * r.x + 1) {
      const std::vector<double> own(at, at + 2 * r.x + 1);
      if (std::ranges::any_of(own, [](double weight) { return weight > 0; }))
        kernel.rows_.push_back(kernel.rowOf(y, z, own));
    }
  return kernel;
}

const float* GaussianBlock::smoothed(const BitWindow& window) {
  const glm::ivec3 size = window.size() - 2 * kernel_->reach();
  values_.resize(std::size_t(blockWidth) * std::size_t(size.y) * std::size_t(size.z));
  if (window.empty() || window.full())
    std::ranges::fill(values_, window.full() ? 1.0f : 0.0f);
  else if (kernel_->alongJAndK_[0].empty())
    smoothRows(window, size);
  else
    smoothSeparably(window, size);
  return values_.data();
}

void GaussianBlock::smoothRows(const BitWindow& window, glm::ivec3 size) {
  const glm::ivec3 reach = kernel_->reach();
  std::ranges::fill(values_, 0.0f);
  float* to = values_.data();
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j, to += blockWidth)
      for (const auto& row : kernel_->rows_)
        addFilteredRow(window.row(j + reach.y - row.y, k + reach.z - row.z), reach.x, row.step.data(),
                       row.sum, to);
}

void GaussianBlock::smoothSeparably(const BitWindow& window, glm::ivec3 size) {
  const glm::ivec3 reach = kernel_->reach(), all = window.size();
  const auto& [alongJ, alongK] = kernel_->alongJAndK_;
  const auto& row = kernel_->rows_[0];
  const std::ptrdiff_t slice = std::ptrdiff_t(blockWidth) * size.y;
  alongI_.resize(std::size_t(blockWidth) * std::size_t(all.y));
  alongJ_.resize(std::size_t(slice) * std::size_t(all.z));
  for (int k = 0; k < all.z; ++k) {
    std::ranges::fill(alongI_, 0.0f);
    for (int j = 0; j < all.y; ++j)
      addFilteredRow(window.row(j, k), reach.x, row.step.data(), row.sum, alongI_.data() + j * blockWidth);
    for (int j = 0; j < size.y; ++j)
      filterAcross(alongJ, alongI_.data() + (j + reach.y) * blockWidth, blockWidth,
                   alongJ_.data() + k * slice + j * blockWidth);
  }
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      filterAcross(alongK, alongJ_.data() + (k + reach.z) * slice + j * blockWidth, slice,
                   values_.data() + k * slice + j * blockWidth);
}

int blockEdgeFor(glm::ivec3 reach) { return std::clamp(std::max(reach.y, reach.z), 16, 64); }

}  // namespace volumen
