#include "viewer/slice/curved_volume.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "viewer/slice/slice.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using glm::dmat3, glm::dvec3;

constexpr double smallestVoxel = 1e-6, noLength = 1e-6;  // mm
constexpr double upright = 0.7;  // least |z| of a unit vector that runs along the patient rather than across

dvec3 meanOf(const std::vector<dvec3>& points) {
  return std::accumulate(points.begin(), points.end(), dvec3(0)) / double(points.size());
}

// Returns the unit vector of v without its part along a unit vector, or `otherwise` if nothing is left.
dvec3 acrossOf(dvec3 v, dvec3 along, dvec3 otherwise) {
  const dvec3 across = v - along * glm::dot(v, along);
  return glm::length(across) > 1e-9 ? glm::normalize(across) : otherwise;
}

// Returns a unit vector perpendicular to a unit vector.
dvec3 anyAcross(dvec3 along) {
  return acrossOf(std::abs(along.z) < upright ? dvec3(0, 0, 1) : dvec3(1, 0, 0), along, {});
}

dvec3 withLargestAboveZero(dvec3 v) {
  int largest = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(v[a]) > std::abs(v[largest]) + 1e-9) largest = a;
  return v[largest] < 0 ? -v : v;
}

// The line that becomes straight: a curve, or its projection onto a plane.
class StraightLine {
 public:
  StraightLine(const SmoothCurve& curve, const CurvedRecipe& recipe);
  double length() const { return laid_.back(); }
  /// Returns a section without directions across. `before` is the direction to use if the line has none
  /// there.
  CurvedGrid::Section sectionAt(double length, dvec3 before) const;

 private:
  dvec3 footOf(dvec3 p) const { return isFoot_ ? p - up_ * glm::dot(p - mean_, up_) : p; }

  const SmoothCurve& curve_;
  bool isFoot_;
  dvec3 mean_, up_;                         // a point of the plane and its normal
  std::vector<double> drawn_{0}, laid_{0};  // arc lengths at sample points: of the curve, of the line
};

StraightLine::StraightLine(const SmoothCurve& curve, const CurvedRecipe& recipe)
    : curve_(curve),
      isFoot_(recipe.kind == CurvedKind::stretched),
      mean_(meanOf(recipe.points)),
      up_(recipe.ruled) {
  constexpr int partsAPiece = 256;
  const std::vector<dvec3> places = curve.line(partsAPiece);
  for (std::size_t n = 1; n < places.size(); ++n) {
    drawn_.push_back(drawn_.back() + glm::distance(places[n - 1], places[n]));
    laid_.push_back(laid_.back() + glm::distance(footOf(places[n - 1]), footOf(places[n])));
  }
}

CurvedGrid::Section StraightLine::sectionAt(double length, dvec3 before) const {
  const auto behind = std::upper_bound(laid_.begin() + 1, laid_.end() - 1, length);
  const std::size_t n = std::size_t(behind - laid_.begin());
  const double width = laid_[n] - laid_[n - 1];
  const double share = width > 0 ? std::clamp((length - laid_[n - 1]) / width, 0.0, 1.0) : 0;
  const double drawn = drawn_[n - 1] + share * (drawn_[n] - drawn_[n - 1]);
  const dvec3 along = curve_.tangent(drawn);
  return {footOf(curve_.at(drawn)), {}, {}, isFoot_ ? acrossOf(along, up_, before) : along, drawn};
}

// An interval along a direction, mm.
struct Reach {
  double low, high;
  double mm() const { return high - low; }
};

// Returns the extent of a volume's box from a point along a unit vector, limited to mostAlongRuled.
Reach alongRuled(const VoxelGeometry& source, dvec3 from, dvec3 ruled) {
  Reach reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const dvec3& corner : source.boxCorners()) {
    const double mm = glm::dot(corner - from, ruled);
    reach = {std::min(reach.low, mm), std::max(reach.high, mm)};
  }
  constexpr double most = CurvedGrid::mostAlongRuled;
  return {std::clamp(reach.low, -most, 0.0), std::clamp(reach.high, 0.0, most)};
}

// Evenly spaced samples, one of them at 0.
struct EvenSamples {
  double first;  // mm
  int count;
};
EvenSamples samplesWithin(Reach reach, double distance) {
  const double from = std::ceil(reach.low / distance - 1e-9), to = std::floor(reach.high / distance + 1e-9);
  return {from * distance, int(to - from) + 1};
}

Status checkRecipe(const CurvedRecipe& recipe, const VoxelGeometry& source) {
  if (!source.calibrated) return Error{"The series is not calibrated: a curved plane needs lengths in mm."};
  if (recipe.points.size() > CurvedGrid::mostPoints) return Error{"A curve has at most 2000 points."};
  if (!(recipe.halfWidth > 0 && recipe.halfWidth <= CurvedGrid::longest))
    return Error{"A curved plane reaches more than 0 mm and at most 10 m across its curve."};
  if (!(std::abs(glm::length(recipe.ruled) - 1) < 1e-6))
    return Error{"The direction that a curved plane is stretched along is no unit vector."};
  return {};
}

}  // namespace

// Two reflections (Wang et al. 2008, table I).
dvec3 carriedAcross(dvec3 across, const CurvedGrid::Section& from, const CurvedGrid::Section& to) {
  const auto reflect = [](dvec3 v, dvec3 mirror) {
    const double squared = glm::dot(mirror, mirror);
    return squared > 0 ? v - mirror * (2 * glm::dot(mirror, v) / squared) : v;
  };
  const dvec3 way = to.at - from.at;
  const dvec3 turn = to.along - reflect(from.along, way);
  return acrossOf(reflect(reflect(across, way), turn), to.along, anyAcross(to.along));
}

dvec3 ruledDirection(const std::vector<dvec3>& points, dvec3 otherwise) {
  const dvec3 mean = meanOf(points);
  dvec3 furthest(0);
  for (const dvec3 p : points)
    if (glm::length(p - mean) > glm::length(furthest)) furthest = p - mean;
  if (glm::length(furthest) == 0) return glm::normalize(otherwise);
  // The smallest eigenvector of the points' covariance, by Jacobi rotations.
  dmat3 spread(0), basis(1);
  for (const dvec3 p : points) spread += glm::outerProduct(p - mean, p - mean);
  for (int sweep = 0; sweep < 30; ++sweep)
    for (const auto& [i, j] : {std::pair(0, 1), {0, 2}, {1, 2}}) {
      const double angle = 0.5 * std::atan2(2 * spread[i][j], spread[j][j] - spread[i][i]);
      dmat3 turn(1);
      turn[i][i] = turn[j][j] = std::cos(angle);
      turn[i][j] = -std::sin(angle), turn[j][i] = std::sin(angle);
      spread = glm::transpose(turn) * spread * turn;
      basis = basis * turn;
    }
  int order[] = {0, 1, 2};
  std::ranges::sort(order, {}, [&](int n) { return spread[n][n]; });
  const bool isLine = spread[order[1]][order[1]] <= 1e-6 * spread[order[2]][order[2]];
  if (!isLine) return withLargestAboveZero(glm::normalize(basis[order[0]]));
  const dvec3 along = glm::normalize(furthest);
  return withLargestAboveZero(acrossOf(otherwise, along, anyAcross(along)));
}

Result<CurvedGrid> CurvedGrid::make(const CurvedRecipe& recipe, const VoxelGeometry& source) {
  if (const Status valid = checkRecipe(recipe, source); !valid) return valid.error();
  const bool isStretched = recipe.kind == CurvedKind::stretched;
  if (recipe.points.empty()) return Error{"A curve needs points at two different places: set another one."};
  const auto curve = SmoothCurve::through(recipe.points);
  if (!curve) return curve.error();
  const StraightLine line(*curve, recipe);
  if (line.length() < noLength)
    return Error{"A curve needs points at two different places: set another one."};
  const dvec3 spacing = source.spacing();
  double step = std::min({spacing.x, spacing.y, spacing.z});
  if (!(step >= smallestVoxel && step <= longest)) return Error{"The voxels of the series have no size."};
  if (line.length() < step) return Error{"The curve is shorter than a voxel: set its points further apart."};
  if (line.length() > longest) return Error{"The curve is longer than 10 m."};
  CurvedGrid grid;
  grid.recipe_ = recipe;
  grid.length_ = line.length();
  const Reach across{-recipe.halfWidth, recipe.halfWidth};
  const Reach down = isStretched ? alongRuled(source, meanOf(recipe.points), recipe.ruled) : across;
  step = std::max(step, grid.length_ / mostSections);
  for (;;) {
    const double voxels = (across.mm() / step + 1) * (down.mm() / step + 1) * (grid.length_ / step + 1);
    if (voxels <= mostVoxels) break;
    step *= std::max(1.01, std::cbrt(voxels / mostVoxels));
  }
  const int parts = std::max(1, int(std::lround(grid.length_ / step)));
  dvec3 along = anyAcross(recipe.ruled);
  for (int n = 0; n <= parts; ++n) {
    grid.sections_.push_back(line.sectionAt(grid.length_ * n / parts, along));
    along = grid.sections_.back().along;
  }
  grid.setFrames();
  const EvenSamples i = samplesWithin(across, step), j = samplesWithin(down, step);
  const double alongStep = grid.length_ / double(grid.sections_.size() - 1);
  grid.geometry_.size = {i.count, j.count, int(grid.sections_.size())};
  grid.geometry_.patientFromVoxelStep = grid.axes_ * dmat3(step, 0, 0, 0, step, 0, 0, 0, alongStep);
  grid.geometry_.origin = grid.axes_ * dvec3(i.first, j.first, 0);
  return grid;
}

void CurvedGrid::setFrames() {
  if (recipe_.kind == CurvedKind::stretched) {
    axes_ = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
    for (Section& section : sections_)
      section.down = recipe_.ruled, section.right = glm::cross(section.down, section.along);
    return;
  }
  Section& first = sections_.front();
  if (first.along.z < upright) axes_ = {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  // Oriented as usual: the patient's left is on the right, or the head on top.
  first.right = std::abs(first.along.z) < upright ? glm::cross(anyAcross(first.along), first.along)
                                                  : anyAcross(first.along);
  for (std::size_t n = 1; n < sections_.size(); ++n)
    sections_[n].right = carriedAcross(sections_[n - 1].right, sections_[n - 1], sections_[n]);
  for (Section& section : sections_) section.down = glm::cross(section.along, section.right);
}

dvec3 CurvedGrid::patientFromCurved(dvec3 p) const {
  const dvec3 local = glm::transpose(axes_) * p;
  const double last = double(sections_.size() - 1), step = length_ / last;
  const double n = std::clamp(std::round(local.z / step), 0.0, last);
  const Section& section = sections_[std::size_t(n)];
  return section.at + section.right * local.x + section.down * local.y + section.along * (local.z - n * step);
}

dvec3 CurvedGrid::curvedFromPatient(dvec3 pPatient) const {
  const auto distance = [&](const Section& section) {
    dvec3 way = pPatient - section.at;
    if (recipe_.kind == CurvedKind::stretched) way -= recipe_.ruled * glm::dot(way, recipe_.ruled);
    return glm::dot(way, way);
  };
  const auto nearest = std::ranges::min_element(sections_, {}, distance);
  const dvec3 way = pPatient - nearest->at;
  const double step = length_ / double(sections_.size() - 1);
  const double s = double(nearest - sections_.begin()) * step + glm::dot(way, nearest->along);
  return axes_ *
         dvec3(glm::dot(way, nearest->right), glm::dot(way, nearest->down), std::clamp(s, 0.0, length_));
}

double CurvedGrid::alongCurve(dvec3 p) const {
  const double last = double(sections_.size() - 1);
  const double n = std::clamp((glm::transpose(axes_) * p).z / length_ * last, 0.0, last);
  const std::size_t before = std::size_t(n), behind = std::min(before + 1, sections_.size() - 1);
  return glm::mix(sections_[before].mm, sections_[behind].mm, n - double(before));
}

namespace {

// Returns the plane of a cross-section with one pixel per voxel of the grid.
SlicePlane planeOf(const CurvedGrid::Section& section, const VoxelGeometry& grid) {
  const dvec3 first = glm::inverse(grid.patientFromVoxelStep) * grid.origin, mm = grid.spacing();
  SlicePlane plane;
  plane.right = section.right, plane.down = section.down;
  plane.centre = section.at + section.right * ((first.x + (grid.size.x - 1) / 2.0) * mm.x) +
                 section.down * ((first.y + (grid.size.y - 1) / 2.0) * mm.y);
  plane.mmPerPixel = mm.x;
  plane.size = {grid.size.x, grid.size.y};
  return plane;
}

// Extends the range by the float32 roundings of its ends.
ValueRange withFloat32(ValueRange range) {
  const double low = double(float(range.low)), high = double(float(range.high));
  return {std::min(range.low, low), std::max({range.high, low, high})};
}

// Returns the padding of the source, else a value below `least`.
ValueRange paddingFor(const Volume& source, float least) {
  const float below = std::nextafter(std::floor(least) - 1, -std::numeric_limits<float>::infinity());
  return withFloat32(source.attributes().padding.value_or(ValueRange{below, below}));
}

// Returns whether any voxel that this position interpolates is padding.
bool isBesidePadding(const Volume& source, ValueRange padding, dvec3 pVoxel) {
  constexpr double steps = 1 << 24;  // positions are rounded to this
  const dvec3 x = glm::clamp(glm::round(pVoxel * steps) / steps, dvec3(0), dvec3(source.size() - 1));
  const glm::ivec3 from(glm::floor(x)), to(glm::ceil(x));
  for (int k = from.z; k <= to.z; ++k)
    for (int j = from.y; j <= to.y; ++j)
      for (int i = from.x; i <= to.x; ++i)
        if (const double v = double(source.value(i, j, k)); v >= padding.low && v <= padding.high)
          return true;
  return false;
}

// Sets values that interpolate padding to NaN.
void leaveOutPadding(const Volume& source, const SlicePlane& plane, std::vector<float>& values) {
  if (!source.attributes().padding) return;
  const ValueRange padding = withFloat32(*source.attributes().padding);
  const auto voxelAt = [&](double x, double y) {
    return source.geometry().voxelFromPatient(plane.patientFromPixel({x + 0.5, y + 0.5}));
  };
  const dvec3 first = voxelAt(0, 0), right = voxelAt(1, 0) - first, down = voxelAt(0, 1) - first;
  parallelFor(plane.size.y, 0, [&](std::int64_t begin, std::int64_t end) {
    for (int j = int(begin); j < int(end); ++j)
      for (int i = 0; i < plane.size.x; ++i) {
        float& value = values[std::size_t(j) * std::size_t(plane.size.x) + std::size_t(i)];
        if (std::isnan(value)) continue;
        if (isBesidePadding(source, padding, first + right * double(i) + down * double(j)))
          value = std::numeric_limits<float>::quiet_NaN();
      }
  });
}

}  // namespace

Result<VolumePtr> curvedVolume(const Volume& source, const CurvedRecipe& recipe,
                               const std::function<void(std::size_t, std::size_t)>& progress,
                               const CancelToken& cancel) {
  const Result<CurvedGrid> grid = CurvedGrid::make(recipe, source.geometry());
  if (!grid) return grid.error();
  VolumeParts parts;
  parts.geometry = grid->geometry();
  std::vector<float> values;
  values.reserve(std::size_t(parts.geometry.voxelCount()));
  for (std::size_t n = 0; n < grid->sections().size(); ++n) {
    const SlicePlane plane = planeOf(grid->sections()[n], parts.geometry);
    Result<SliceValues> slice = resampleSlice(source, plane, 0, cancel);
    if (!slice) return slice.error();
    leaveOutPadding(source, plane, slice->values);
    values.insert(values.end(), slice->values.begin(), slice->values.end());
    if (progress) progress(n + 1, grid->sections().size());
  }
  float least = std::numeric_limits<float>::infinity();
  for (const float v : values)
    if (v < least) least = v;  // false for NaN
  if (std::isinf(least)) return Error{"The curve lies outside the series: set its points within it."};
  const ValueRange padding = paddingFor(source, least);
  std::ranges::replace_if(
      values, [](float v) { return std::isnan(v); }, float(padding.low));
  parts.values = std::move(values);
  parts.attributes = source.attributes();
  parts.attributes.padding = padding;
  std::vector<std::string> warnings;
  return Volume::make(std::move(parts), warnings);
}

}  // namespace volumen
