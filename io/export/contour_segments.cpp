#include "io/export/contour_segments.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "io/segmentation.h"
#include "viewer/segment/pixel_outlines.h"
#include "viewer/slice/plane.h"

namespace volumen {

namespace {

bool isClosed(const Contour& contour) {
  return (contour.type == Contour::Type::closedPlanar || contour.type == Contour::Type::closedPlanarXor) &&
         contour.points.size() >= 3;
}

// The contours of a region in one plane.
struct ContourPlane {
  double along;  // along k of the grid, in slices
  Outlines outlines;
};

std::string mlWords(double mm3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g ml", mm3 / 1000);
  return text;
}

Segment segmentFrom(const RegionOfInterest& region, std::size_t n) {
  Segment segment{.number = int(n) + 1, .label = region.name, .description = region.description};
  segment.type = region.code;
  segment.colour = region.colour;
  const auto term = std::ranges::find(segmentAlgorithmTerms, region.algorithm);
  if (term != segmentAlgorithmTerms.end())
    segment.algorithmType = SegmentAlgorithm(term - segmentAlgorithmTerms.begin());
  return segment;
}

// Fills the contours of regions.
class ContourFiller {
 public:
  ContourFiller(const VoxelGeometry& grid, const std::vector<double>& places)
      : grid_(grid), places_(places), spacing_(grid.spacing()), distance_(sliceDistance(grid)) {
    all_.size = glm::ivec2(grid.size);
    all_.right = grid.patientFromVoxelStep[0] / spacing_.x;
    all_.down = grid.patientFromVoxelStep[1] / spacing_.y;
    all_.mm = glm::dvec2(spacing_);
  }

  Segmentation run(const StructureSet& set, const CancelToken& cancel) {
    for (const std::string& warning : set.warnings) all_.notes.push_back(warning);
    std::vector<std::vector<ContourPlane>> planes;
    for (const RegionOfInterest& region : set.regions) planes.push_back(planesOf(region));
    all_.thickness = distance_ * stepOf(planes);
    BitPacker bits;
    for (std::size_t n = 0; n < planes.size() && !cancel.cancelled(); ++n) {
      if (planes[n].empty()) continue;
      all_.segments.push_back(segmentFrom(set.regions[n], n));
      fill(planes[n], set.regions[n].name, bits);
    }
    all_.bits = bits.bytes();
    return std::move(all_);
  }

 private:
  static constexpr double samePlane = 0.05;  // slices; positions are rounded

  // Sorts the contours of a region into planes. An outline must stay within half a slice of its plane.
  std::vector<ContourPlane> planesOf(const RegionOfInterest& region) {
    std::vector<std::pair<double, std::vector<glm::dvec2>>> outlines;
    std::size_t left = 0;
    for (const Contour& contour : region.contours) {
      double low = 0, high = 0;
      std::vector<glm::dvec2> outline;
      for (const glm::dvec3 p : contour.points) {
        const glm::dvec3 voxel = grid_.voxelFromPatient(p);
        low = outline.empty() ? voxel.z : std::min(low, voxel.z);
        high = outline.empty() ? voxel.z : std::max(high, voxel.z);
        outline.emplace_back(voxel);
      }
      if (isClosed(contour) && high - low <= 0.5)
        outlines.emplace_back((low + high) / 2, std::move(outline));
      else
        ++left;
    }
    if (left > 0)
      all_.notes.push_back("Of " + region.name + ", " + std::to_string(left) +
                           " contours are left out: they are points, lines or outlines across the slices.");
    std::ranges::stable_sort(outlines, {}, [](const auto& one) { return one.first; });
    std::vector<ContourPlane> planes;
    for (auto& [along, outline] : outlines) {
      if (planes.empty() || along - planes.back().along > samePlane) planes.push_back({along, {}});
      planes.back().outlines.push_back(std::move(outline));
    }
    return planes;
  }

  bool isOnSlice(double along) const {
    if (places_.empty()) return std::abs(along - std::round(along)) < samePlane;
    return std::ranges::any_of(places_, [&](double place) { return std::abs(along - place) < samePlane; });
  }

  // Returns the distance of planes in slices.
  double stepOf(const std::vector<std::vector<ContourPlane>>& all) const {
    double smallest = 0;
    bool isOfSlices = true;
    for (const auto& planes : all)
      for (std::size_t n = 0; n < planes.size(); ++n) {
        isOfSlices = isOfSlices && isOnSlice(planes[n].along);
        const double gap = n > 0 ? planes[n].along - planes[n - 1].along : 0;
        if (gap > 0 && (smallest == 0 || gap < smallest)) smallest = gap;
      }
    return isOfSlices ? 1 : std::max(1.0, smallest);
  }

  void fill(const std::vector<ContourPlane>& planes, const std::string& name, BitPacker& bits) {
    const double pixel = spacing_.x * spacing_.y * all_.thickness;
    double enclosed = 0, filled = 0;
    std::size_t tooMany = 0;
    for (const ContourPlane& plane : planes) {
      enclosed += evenOddArea(plane.outlines) * pixel;
      const std::vector<std::uint8_t> pixels = filledEvenOdd(plane.outlines, all_.size);
      tooMany += pixels.empty();
      if (std::ranges::find(pixels, std::uint8_t(1)) == pixels.end()) continue;
      filled += double(std::ranges::count(pixels, std::uint8_t(1))) * pixel;
      all_.frames.push_back({all_.segments.size() - 1, grid_.patientFromVoxel({0, 0, plane.along})});
      add(pixels, bits);
    }
    note(name, enclosed, filled, tooMany);
    noteGaps(planes, name);
  }

  static void add(const std::vector<std::uint8_t>& pixels, BitPacker& bits) {
    for (std::size_t n = 0; n < pixels.size(); n += 64) {
      const std::size_t count = std::min<std::size_t>(64, pixels.size() - n);
      std::uint64_t word = 0;
      for (std::size_t bit = 0; bit < count; ++bit) word |= std::uint64_t(pixels[n + bit]) << bit;
      bits.add(word, int(count));
    }
  }

  void note(const std::string& name, double enclosed, double filled, std::size_t tooMany) {
    constexpr double off = 0.01;
    if (tooMany > 0)
      all_.notes.push_back("Of " + name + ", " + std::to_string(tooMany) +
                           " planes are left out: their contours have too many points.");
    else if (std::abs(enclosed - filled) > off * enclosed)
      all_.notes.push_back("The contours of " + name + " enclose " + mlWords(enclosed) +
                           "; the pixels whose centres lie inside are " + mlWords(filled) + ".");
  }

  void noteGaps(const std::vector<ContourPlane>& planes, const std::string& name) {
    const double step = all_.thickness / distance_;
    bool isSparse = planes.size() > 2;
    for (std::size_t n = 1; n < planes.size(); ++n)
      isSparse = isSparse && planes[n].along - planes[n - 1].along > 1.5 * step;
    if (isSparse)
      all_.notes.push_back("No two neighbouring slices have contours of " + name +
                           ": nothing is marked between those that have.");
  }

  const VoxelGeometry& grid_;
  const std::vector<double>& places_;
  glm::dvec3 spacing_;
  double distance_;
  Segmentation all_;
};

}  // namespace

Segmentation filledContours(const StructureSet& contours, const VoxelGeometry& grid,
                            const std::vector<double>& places, const CancelToken& cancel) {
  return ContourFiller(grid, places).run(contours, cancel);
}

}  // namespace volumen
