#include "viewer/measure/peak.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>

#include "viewer/measure/region.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Upper bound. Lines through the ball are cut exactly along their length.
constexpr double mmBetweenLines = 0.1;
constexpr double mostBallVoxels = 1e6;

// The part of a line of voxels inside the ball: |a + t b| <= radius.
struct Chord {
  double low = 0, high = 0;
  bool empty() const { return !(low < high); }
};

Chord chordOf(glm::dvec3 a, glm::dvec3 b, double radius) {
  const double bb = glm::dot(b, b), ab = glm::dot(a, b), rest = glm::dot(a, a) - radius * radius;
  const double root = ab * ab - bb * rest;
  if (!(root > 0)) return {};
  const double half = std::sqrt(root) / bb, middle = -ab / bb;
  return {middle - half, middle + half};
}

// Returns the number of lines that cross a voxel along an axis.
int linesAcross(double spacing) { return int(std::clamp(std::ceil(spacing / mmBetweenLines), 1.0, 200.0)); }

}  // namespace

const double peakRadius = std::cbrt(3 * 1000 / (4 * std::numbers::pi));

std::vector<BallVoxel> ballVoxels(const VoxelGeometry& geometry, double radius) {
  const glm::dmat3 rows = glm::transpose(geometry.voxelFromPatientStep());
  glm::ivec3 reach;
  double box = 1;
  for (int a = 0; a < 3; ++a) {
    const double voxels = std::ceil(radius * glm::length(rows[a]) + 0.5);
    if (!((box *= 2 * voxels + 1) <= 2 * mostBallVoxels)) return {};
    reach[a] = int(voxels);
  }
  const glm::dmat3& step = geometry.patientFromVoxelStep;
  const glm::dvec3 spacing = geometry.spacing();
  const int across = linesAcross(spacing.x), down = linesAcross(spacing.y);
  std::vector<BallVoxel> ball;
  std::vector<double> shares(std::size_t(2 * reach.z + 1));
  for (int j = -reach.y; j <= reach.y; ++j)
    for (int i = -reach.x; i <= reach.x; ++i) {
      std::ranges::fill(shares, 0);
      for (int v = 0; v < down; ++v)
        for (int u = 0; u < across; ++u) {
          const double x = i - 0.5 + (u + 0.5) / across, y = j - 0.5 + (v + 0.5) / down;
          const Chord chord = chordOf(x * step[0] + y * step[1], step[2], radius);
          if (chord.empty()) continue;
          for (int k = -reach.z; k <= reach.z; ++k)
            shares[std::size_t(k + reach.z)] +=
                std::max(0.0, std::min(chord.high, k + 0.5) - std::max(chord.low, k - 0.5));
        }
      for (int k = -reach.z; k <= reach.z; ++k)
        if (const double share = shares[std::size_t(k + reach.z)] / (double(across) * down); share > 0)
          ball.push_back({{i, j, k}, share});
    }
  return ball;
}

namespace {

// Returns the mean over a ball about a voxel; empty if no voxel of it counts.
std::optional<double> ballMean(const std::vector<BallVoxel>& ball, glm::ivec3 about, const Volume& volume) {
  const std::optional<ValueRange>& padding = volume.attributes().padding;
  double sum = 0, shares = 0;
  for (const BallVoxel& part : ball) {
    const glm::ivec3 x = about + part.step;
    if (glm::any(glm::lessThan(x, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(x, volume.size())))
      continue;
    const double value = double(volume.value(x.x, x.y, x.z));
    if (isPadding(padding, value)) continue;
    sum += part.share * value;
    shares += part.share;
  }
  return shares > 0 ? std::optional(sum / shares) : std::nullopt;
}

}  // namespace

std::optional<ValuePeak> peakAbout(std::span<const glm::ivec3> voxels, const Volume& volume,
                                   const CancelToken& cancel) {
  const VoxelGeometry& geometry = volume.geometry();
  if (!geometry.calibrated) return {};
  const std::vector<BallVoxel> ball = ballVoxels(geometry, peakRadius);
  if (ball.empty()) return {};
  std::vector<std::optional<double>> means(voxels.size());
  parallelFor(std::int64_t(voxels.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    for (auto n = std::size_t(begin); n < std::size_t(end) && !cancel.cancelled(); ++n)
      means[n] = ballMean(ball, voxels[n], volume);
  });
  if (cancel.cancelled()) return {};
  const auto largest = std::ranges::max_element(means);  // An empty mean is less than any other.
  if (largest == means.end() || !*largest) return {};
  const glm::ivec3 centre = voxels[std::size_t(largest - means.begin())];
  return ValuePeak{**largest, geometry.patientFromVoxel(glm::dvec3(centre))};
}

std::optional<ValuePeak> regionPeak(const Shape& region, const Volume& volume, const CancelToken& cancel) {
  std::vector<glm::ivec3> voxels;
  forEachVoxelOf(region, volume, [&](glm::ivec3 voxel, double) { voxels.push_back(voxel); });
  return peakAbout(voxels, volume, cancel);
}

}  // namespace volumen
