#pragma once

#include <QColor>
#include <algorithm>
#include <map>
#include <vector>

#include "ui/controller/segment_layer.h"

namespace volumen::tests {

/// A reference model of how segments cover the samples of each pixel of a slice, by the definition. Pixels in
/// which rounding decides a sample are unsure.
class PlaceTwin {
 public:
  PlaceTwin(const SegmentLayer& layer, const SlicePlane& plane) : layer_(layer), plane_(plane) {
    const VoxelGeometry& grid = layer.labels->geometry();
    const auto voxelAt = [&](glm::dvec2 p) { return grid.voxelFromPatient(plane.patientFromPixel(p)); };
    for (int a = 0; a < 2; ++a)
      parts_[a] = std::max(1, int(std::ceil(glm::length(voxelAt({a == 0, a == 1}) - voxelAt({0, 0})) / 1.3)));
    for (int y = 0; y < plane.size.y; ++y)
      for (int x = 0; x < plane.size.x; ++x) pixels_.push_back(lookAt(x, y));
  }

  /// Returns whether the pixel and its neighbours are sure.
  bool isSure(int x, int y) const {
    return at(x, y).isSure && at(x - 1, y).isSure && at(x + 1, y).isSure && at(x, y - 1).isSure &&
           at(x, y + 1).isSure;
  }
  /// Returns the colour of the pixel over `under`, 0 to 255.
  glm::dvec3 colour(int x, int y, glm::dvec3 under) const {
    const double all = 5 * parts_.x * parts_.y;
    double covered = 0, hidden = 0;
    glm::dvec3 sum(0);
    for (std::size_t n = 0; n < layer_.shown.size(); ++n) {
      const int number = int(n) + 1, here = count(x, y, number);
      const int beside[] = {count(x - 1, y, number), count(x + 1, y, number), count(x, y - 1, number),
                            count(x, y + 1, number)};
      const int inner = std::min(here, *std::ranges::min_element(beside));
      const bool isThin = here > 0 && *std::ranges::max_element(beside) <= here;
      const int seen = isThin ? std::max(here, int(std::ceil(all / 2))) : here;
      const double part = layer_.opacity * layer_.shown[n].opacity;
      const double hides = inner * part + (seen - inner) * std::min(1.0, 2 * part);
      const QRgb c = layer_.shown[n].colour;
      covered += seen, hidden += hides, sum += hides * glm::dvec3(qRed(c), qGreen(c), qBlue(c));
    }
    const double whole = std::max(all, covered);
    return (1 - hidden / whole) * under + sum / whole;
  }

 private:
  struct Pixel {
    std::map<int, int> counts;
    bool isSure = true;
  };

  // Pixels outside the picture equal the nearest inside.
  const Pixel& at(int x, int y) const {
    const glm::ivec2 held = glm::clamp(glm::ivec2(x, y), glm::ivec2(0), plane_.size - 1);
    return pixels_[std::size_t(held.y * plane_.size.x + held.x)];
  }
  int count(int x, int y, int number) const {
    const auto found = at(x, y).counts.find(number);
    return found == at(x, y).counts.end() ? 0 : found->second;
  }
  Pixel lookAt(int x, int y) const {
    Pixel pixel;
    for (int j = 0; j < parts_.y; ++j)
      for (int i = 0; i < parts_.x; ++i)
        for (const glm::dvec2 from : {glm::dvec2(0, 0), {0.2, 0.4}, {0.4, -0.2}, {-0.2, -0.4}, {-0.4, 0.2}}) {
          const glm::dvec2 inPixel = (glm::dvec2(i, j) + 0.5 + from) / glm::dvec2(parts_);
          ++pixel.counts[look(glm::dvec2(x, y) + inPixel, pixel.isSure)];
        }
    return pixel;
  }
  int shownOf(glm::ivec3 voxel) const {
    const glm::ivec3 held = glm::clamp(voxel, glm::ivec3(0), layer_.labels->geometry().size - 1);
    const auto found =
        std::ranges::find(layer_.shown, layer_.labels->at(held), &SegmentLayer::Shown::segment);
    return found == layer_.shown.end() ? 0 : int(found - layer_.shown.begin()) + 1;
  }
  int look(glm::dvec2 pPixel, bool& isSure) const {
    constexpr double rounding = 1e-4, shareRounding = 2e-3;
    const VoxelGeometry& grid = layer_.labels->geometry();
    const glm::dvec3 v = grid.voxelFromPatient(plane_.patientFromPixel(pPixel));
    const glm::dvec3 toFace = glm::abs(v + 0.5 - glm::round(v + 0.5));
    const bool isAtFace = std::min({toFace.x, toFace.y, toFace.z}) < rounding;
    for (int a = 0; a < 3; ++a)
      if (v[a] < -0.5 || v[a] >= grid.size[a] - 0.5) return isSure = isSure && !isAtFace, 0;
    if (plane_.interpolation == Interpolation::nearest)
      return isSure = isSure && !isAtFace, shownOf(glm::ivec3(glm::floor(v + 0.5)));
    std::map<int, double> shares;
    for (int c = 0; c < 8; ++c) {
      const glm::ivec3 voxel = glm::ivec3(glm::floor(v)) + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
      const glm::dvec3 share = 1.0 - glm::abs(v - glm::dvec3(voxel));
      shares[shownOf(voxel)] += share.x * share.y * share.z;
    }
    const auto largest = std::ranges::max_element(shares, {}, [](const auto& one) { return one.second; });
    for (const auto& [number, share] : shares)
      isSure = isSure && (number == largest->first || share < largest->second - shareRounding);
    return largest->first;
  }

  const SegmentLayer& layer_;
  const SlicePlane& plane_;
  glm::ivec2 parts_;
  std::vector<Pixel> pixels_;
};

}  // namespace volumen::tests
