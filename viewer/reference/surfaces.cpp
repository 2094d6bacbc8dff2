#include "viewer/reference/surfaces.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "viewer/reference/cell.h"
#include "viewer/reference/march.h"

namespace volumen::reference {

namespace {

constexpr double surfaceLevel = 0.5;
constexpr double leftLater = 1e-3, nextLater = 1e-6;  // Distances in voxels.

// The field of a segment, in voxels of its box.
class Field {
 public:
  explicit Field(const OccupancyField& field) : field_(field), geometry_(field.geometry) {
    geometry_.size = field.size();
    geometry_.origin = field.geometry.patientFromVoxel(field.box.low);
  }
  const VoxelGeometry& geometry() const { return geometry_; }
  /// Returns true if the cell lies between voxels of the box.
  bool holds(glm::ivec3 cell) const {
    return glm::all(glm::greaterThanEqual(cell, glm::ivec3(0))) &&
           glm::all(glm::lessThan(cell, geometry_.size - 1));
  }
  Corners<double> cornerValues(glm::ivec3 cell) const {
    Corners<double> corners;
    for (int n = 0; n < 8; ++n) corners[n] = value(cornerOf(cell, n));
    return corners;
  }
  /// Returns the gradient in value per mm at a position of the cell (picture.md 3).
  glm::dvec3 gradientAt(glm::ivec3 cell, glm::dvec3 place) const {
    Corners<glm::dvec3> corners;
    for (int n = 0; n < 8; ++n) corners[n] = sobel(cornerOf(cell, n));
    return geometry_.patientFromVoxelGradient() * interpolateAlong(corners, place, glm::dvec3(0)).c[0];
  }

 private:
  static glm::ivec3 cornerOf(glm::ivec3 cell, int n) { return cell + glm::ivec3(n & 1, n >> 1 & 1, n >> 2); }
  double value(glm::ivec3 at) const {
    const glm::i64vec3 size = geometry_.size;
    if (glm::any(glm::lessThan(at, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(at, geometry_.size)))
      return 0;
    return field_.values[std::size_t((at.z * size.y + at.y) * size.x + at.x)];
  }
  glm::dvec3 sobel(glm::ivec3 voxel) const {
    static constexpr double derivative[3] = {-0.5, 0, 0.5}, smooth[3] = {0.25, 0.5, 0.25};
    glm::dvec3 sum(0);
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          sum += value(voxel + glm::ivec3(i, j, k) - 1) * glm::dvec3(derivative[i] * smooth[j] * smooth[k],
                                                                     smooth[i] * derivative[j] * smooth[k],
                                                                     smooth[i] * smooth[j] * derivative[k]);
    return sum;
  }

  const OccupancyField& field_;
  VoxelGeometry geometry_;
};

struct Met {
  SurfaceCrossing crossing;
  double voxelsLater;
};

// Appends the crossings with the surface of one segment along a part of a ray.
void appendCrossings(const SegmentSurface& segment, const Ray& ray, Interval part, const Lighting& lighting,
                     double voxelsLater, std::vector<Met>& met) {
  const Field field(*segment.field);
  const Interval inBox = visibleInterval(ray, field.geometry(), {});
  const Interval both{std::max(part.t0, inBox.t0), std::min(part.t1, inBox.t1)};
  if (both.empty()) return;
  // Between two places of a cell f - 1/2 has one sign. The sign is taken in the middle, so that rounding at
  // the cell's ends does not matter.
  std::vector<double> places;
  bool isKnown = false, isInside = false;
  double t = both.t0;
  marchCells(field.geometry(), ray, both, [&](const CellPiece& piece) {
    Cubic f;
    if (field.holds(piece.cell))
      f = interpolateAlong(field.cornerValues(piece.cell), piece.start, piece.move);
    f.c[0] -= surfaceLevel;
    places.assign({0, 1});
    appendSignChanges(f, places);
    std::ranges::sort(places);
    for (std::size_t n = 0; n + 1 < places.size(); ++n) {
      if (!(places[n + 1] > places[n])) continue;
      const bool inside = f((places[n] + places[n + 1]) / 2) >= 0;
      if (isKnown && inside != isInside) {
        const glm::dvec3 gradient = field.gradientAt(piece.cell, piece.start + places[n] * piece.move);
        met.push_back({{t + places[n] * piece.lengthMm, lighting.shadeSurface(segment.colour, gradient),
                        segment.opacity},
                       voxelsLater + (inside ? 0 : leftLater)});
      }
      isKnown = true, isInside = inside;
    }
    t += piece.lengthMm;
    return true;
  });
}

}  // namespace

Surfaces::Surfaces(const Scene& scene, const VoxelGeometry& geometry)
    : scene_(scene), geometry_(geometry), shown_(shownSegments(scene)) {}

std::vector<SurfaceCrossing> Surfaces::along(const Ray& ray, const Lighting& lighting) const {
  if (shown_.empty()) return {};
  const Interval part = surfaceInterval(ray, geometry_, scene_.clip);
  std::vector<Met> met;
  for (std::size_t n = 0; n < shown_.size(); ++n)
    appendCrossings(*shown_[n], ray, part, lighting, nextLater * double(n), met);
  const double voxelMm = 1 / glm::length(geometry_.voxelFromPatientStep() * ray.direction);
  std::ranges::stable_sort(met, {}, [&](const Met& m) { return m.crossing.t + m.voxelsLater * voxelMm; });
  std::vector<SurfaceCrossing> crossings;
  for (const Met& m : met) crossings.push_back(m.crossing);
  return crossings;
}

}  // namespace volumen::reference
