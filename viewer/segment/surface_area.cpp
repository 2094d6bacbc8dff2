#include "viewer/segment/surface_area.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numeric>

#include "viewer/segment/gaussian.h"

namespace volumen {

namespace {

using glm::dvec3;

constexpr int rowsOfFaces = 48;    // rows of faces in a block, along j and k
constexpr int slopeReach = 2;      // voxels
constexpr double sameWay = 0.985;  // cosine of 10 degrees

// The smoothed mask in a block of blockWidth voxels along i.
class SmoothedBlock {
 public:
  explicit SmoothedBlock(const GaussianKernel& kernel) : reach_(kernel.reach()), smooth_(kernel) {}

  void read(const BitMask& mask, const VoxelBox& box) {
    window_.read(mask, grownBox(box, reach_), BeyondGrid::nothing);
    values_ = smooth_.smoothed(window_);
    row_ = blockWidth, slice_ = row_ * (box.high.y - box.low.y + 1);
  }
  // Returns the slopes along each grid axis, per voxel, by fourth-order differences.
  dvec3 slopes(glm::ivec3 v) const {
    const float* const at = values_ + v.z * slice_ + v.y * row_ + v.x;
    const auto along = [&](std::ptrdiff_t n) {
      return (8 * (double(at[n]) - double(at[-n])) - (double(at[2 * n]) - double(at[-2 * n]))) / 12;
    };
    return {along(1), along(row_), along(slice_)};
  }

 private:
  const glm::ivec3 reach_;
  GaussianBlock smooth_;
  BitWindow window_;
  const float* values_ = nullptr;
  std::ptrdiff_t row_ = 0, slice_ = 0;
};

// Sums the projected area of the faces in a block. Not thread-safe.
class FacesSeen {
 public:
  FacesSeen(const BitMask& mask, const std::vector<BrickFace>& faces, const GaussianKernel& narrow,
            const GaussianKernel& wide, double share)
      : mask_(mask),
        faces_(faces),
        share_(share),
        patientFromSlopes_(glm::transpose(glm::inverse(mask.geometry().patientFromVoxelStep))),
        narrow_(narrow),
        wide_(wide) {}

  // Returns the area of the faces at voxels of `own`. `box`, blockWidth voxels along i, must also hold the
  // voxels that the slopes there and beyond the faces need.
  double area(const VoxelBox& own, const VoxelBox& box) {
    bits_.read(mask_, box, BeyondGrid::nothing);
    if (bits_.empty() || bits_.full()) return 0;
    narrow_.read(mask_, box);
    wide_.read(mask_, box);
    double sum = 0;
    for (const BrickFace& face : faces_) sum += sumOf(face, {own.low - box.low, own.high - box.low});
    return sum;
  }

 private:
  double sumOf(const BrickFace& face, const VoxelBox& own) const;
  double seen(const BrickFace& face, glm::ivec3 voxel) const;

  const BitMask& mask_;
  const std::vector<BrickFace>& faces_;
  const double share_;
  const glm::dmat3 patientFromSlopes_;
  SmoothedBlock narrow_, wide_;
  BitWindow bits_;
};

double FacesSeen::sumOf(const BrickFace& face, const VoxelBox& own) const {
  const glm::ivec3 step = face.step;
  const std::uint64_t columns = ~std::uint64_t(0) >> (63 - own.high.x) & ~std::uint64_t(0) << own.low.x;
  double sum = 0;
  for (int k = own.low.z; k <= own.high.z; ++k)
    for (int j = own.low.y; j <= own.high.y; ++j) {
      const std::uint64_t other = bits_.row(j + step.y, k + step.z)[0];
      std::uint64_t found = bits_.row(j, k)[0] ^ (step.x < 0 ? other << -step.x : other >> step.x);
      for (found &= columns; found; found &= found - 1) sum += seen(face, {std::countr_zero(found), j, k});
    }
  return sum * face.area;
}

// Returns the projection of a face along the normal, as a fraction of its area.
double FacesSeen::seen(const BrickFace& face, glm::ivec3 voxel) const {
  const auto gradient = [&](const SmoothedBlock& of) {
    return patientFromSlopes_ * (of.slopes(voxel) + of.slopes(voxel + face.step));
  };
  const dvec3 narrow = gradient(narrow_), wide = gradient(wide_);
  const double length = glm::length(narrow), wideLength = glm::length(wide);
  if (!(length > 1e-5)) return 1;  // smoothing leaves no gradient, so there is no normal
  const double found = std::abs(glm::dot(narrow, face.normal)) / length;
  // Edges turn the normal by less than this, structures thinner than the Gaussians by more.
  if (!(glm::dot(narrow, wide) > sameWay * length * wideLength)) return found;
  return found + share_ * (found - std::abs(glm::dot(wide, face.normal)) / wideLength);
}

// Returns the two bricks of the next row, shifted by `moved` bricks, that share a brick's face: their offsets
// and their shares of the face.
std::array<std::pair<int, double>, 2> sharesOf(double moved) {
  moved = std::clamp(moved, -20.0, 20.0);  // offsets must stay within a word
  if (std::abs(moved - std::round(moved)) < 1e-6) moved = std::round(moved);
  const double whole = std::floor(moved);
  return {{{-int(whole), 1 - (moved - whole)}, {-int(whole) - 1, moved - whole}}};
}

}  // namespace

std::vector<BrickFace> brickFaces(const VoxelGeometry& geometry) {
  const glm::dmat3& step = geometry.patientFromVoxelStep;
  const dvec3 x = glm::normalize(step[0]), z = glm::normalize(glm::cross(step[0], step[1])),
              y = glm::cross(z, x);
  const dvec3 edge(glm::length(step[0]), glm::dot(step[1], y), std::abs(glm::dot(step[2], z)));
  std::vector<BrickFace> faces{{{1, 0, 0}, x, edge.y * edge.z}};
  const double rowMoved = glm::dot(step[1], x) / edge.x;
  for (const auto& [i, share] : sharesOf(rowMoved))
    if (share > 0) faces.push_back({{i, 1, 0}, y, share * edge.x * edge.z});
  for (const auto& [j, part] : sharesOf(glm::dot(step[2], y) / edge.y))
    for (const auto& [i, share] : sharesOf(glm::dot(step[2], x) / edge.x + j * rowMoved))
      if (part * share > 0) faces.push_back({{i, j, 1}, z, part * share * edge.x * edge.y});
  return faces;
}

AreaSmoothing areaSmoothing(const VoxelGeometry& geometry) {
  const glm::dmat3& step = geometry.patientFromVoxelStep;
  const double longest = std::max({glm::length(step[0]), glm::length(step[1]), glm::length(step[2])});
  const double even = std::cbrt(geometry.voxelVolume());
  const double narrow = 2 * std::sqrt(longest * even);
  // Thick slices hardly distinguish edges from round surfaces, so less is added.
  return {narrow, std::sqrt(2.0) * narrow,
          std::clamp((4.9 - longest / even) / 2.5, 0.0, 1.0) / (std::sqrt(2.0) - 1)};
}

double boundaryArea(const BitMask& mask, const CancelToken& cancel) {
  const std::optional<VoxelBox> voxels = mask.box();
  if (!voxels) return 0;
  const std::vector<BrickFace> faces = brickFaces(mask.geometry());
  const AreaSmoothing smoothing = areaSmoothing(mask.geometry());
  const auto narrow = GaussianKernel::alongAxes(smoothing.narrowMm / mask.geometry().spacing()),
             wide = GaussianKernel::alongAxes(smoothing.wideMm / mask.geometry().spacing());
  glm::ivec3 before(0), behind(0);  // largest steps of the faces
  for (const BrickFace& face : faces)
    before = glm::max(before, -face.step), behind = glm::max(behind, face.step);
  const VoxelBox all{voxels->low - behind, voxels->high + before};
  before += slopeReach, behind += slopeReach;
  const glm::ivec3 edge(blockWidth - before.x - behind.x, rowsOfFaces, rowsOfFaces);
  const glm::i64vec3 blocks = (all.high - all.low + edge) / edge;
  std::vector<double> areas(std::size_t(blocks.x * blocks.y * blocks.z));
  parallelFor(std::int64_t(areas.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    FacesSeen seen(mask, faces, narrow, wide, smoothing.share);
    for (std::int64_t n = begin; n < end && !cancel.cancelled(); ++n) {
      const glm::ivec3 place(n % blocks.x, n / blocks.x % blocks.y, n / blocks.x / blocks.y);
      const VoxelBox own{all.low + place * edge, glm::min(all.low + place * edge + edge - 1, all.high)};
      VoxelBox box{own.low - before, own.high + behind};
      box.high.x = box.low.x + blockWidth - 1;
      areas[std::size_t(n)] = seen.area(own, box);
    }
  });
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

}  // namespace volumen
