#include "viewer/segment/brush.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <tuple>

#include "viewer/segment/closed_outline.h"

namespace volumen {

namespace {

// Distances that differ only by rounding are equal.
constexpr double brushRounding = 1e-9;

struct BrushBox {
  glm::ivec3 low, high;  // inclusive
};

// Returns the box of voxels within `mm` of a line, with one more voxel on each side.
BrushBox boxOfStroke(const VoxelGeometry& grid, glm::dvec3 from, glm::dvec3 to, double mm) {
  // Rows of L^-1: their lengths are the most voxels along an axis that 1 mm can span.
  const glm::dmat3 steps = glm::transpose(grid.voxelFromPatientStep());
  const glm::dvec3 a = grid.voxelFromPatient(from), b = grid.voxelFromPatient(to);
  BrushBox box{};
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = mm * glm::length(steps[axis]) + 1, last = grid.size[axis] - 1;
    box.low[axis] = int(std::clamp(std::ceil(std::min(a[axis], b[axis]) - reach), 0.0, last + 1));
    box.high[axis] = int(std::clamp(std::floor(std::max(a[axis], b[axis]) + reach), -1.0, last));
  }
  return box;
}

// The part of a row, i from low to high, where low <= at + i * step <= high, widened by rounding.
struct RowRange {
  int low, high;

  void keepWhere(double at, double step, double least, double most) {
    if (std::abs(step) < 1e-12) {
      if (at < least || at > most) high = low - 1;
      return;
    }
    const double a = (least - at) / step, b = (most - at) / step;
    const double first = low, last = high;
    low = int(std::clamp(std::ceil(std::min(a, b) - 1e-6), first, last + 1));
    high = int(std::clamp(std::floor(std::max(a, b) + 1e-6), first - 1, last));
  }
};

// Calls row(j, k, range) for all rows of a box.
template <class Row>
void forRows(const BrushBox& box, const Row& row) {
  for (int k = box.low.z; k <= box.high.z; ++k)
    for (int j = box.low.y; j <= box.high.y; ++j) row(j, k, RowRange{box.low.x, box.high.x});
}

// Adds the covered voxels of a row as runs.
template <class IsCovered>
void addRow(VoxelSpans& spans, int j, int k, RowRange range, const IsCovered& isCovered) {
  for (int i = range.low; i <= range.high; ++i) {
    if (!isCovered(i)) continue;
    const int begin = i;
    while (i <= range.high && isCovered(i)) ++i;
    spans.push_back({begin, i, j, k});
  }
}

// Returns the runs in memory order; overlapping or touching ones are merged.
VoxelSpans mergedSpans(VoxelSpans spans) {
  std::ranges::sort(spans, {}, [](const RowSpan& s) { return std::tuple(s.k, s.j, s.begin); });
  VoxelSpans all;
  for (const RowSpan& span : spans) {
    RowSpan* last = all.empty() ? nullptr : &all.back();
    if (last && last->k == span.k && last->j == span.j && span.begin <= last->end)
      last->end = std::max(last->end, span.end);
    else
      all.push_back(span);
  }
  return all;
}

// Decides which voxels a plane cuts. If it lies between two neighbours, it cuts the one with the larger
// index, which the slice shows.
class CutByPlane {
 public:
  CutByPlane(const VoxelGeometry& grid, glm::dvec3 at, glm::dvec3 normal)
      : at_(grid.voxelFromPatient(at)),
        perVoxel_(glm::transpose(grid.patientFromVoxelStep) * glm::normalize(normal)) {
    const glm::dvec3 size = glm::abs(perVoxel_);
    const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (perVoxel_[longest] < 0) perVoxel_ = -perVoxel_;
    half_ = (size.x + size.y + size.z) / 2;
  }

  void narrow(int j, int k, RowRange& range) const {
    range.keepWhere(distance({0, j, k}), perVoxel_.x, -half_, half_);
  }
  bool cuts(glm::ivec3 voxel) const {
    const double d = distance(voxel), rounding = brushRounding * half_;
    return d > -half_ + rounding && d <= half_ + rounding;
  }

 private:
  double distance(glm::dvec3 voxel) const { return glm::dot(perVoxel_, voxel - at_); }

  glm::dvec3 at_, perVoxel_;
  double half_;  // half extent of a voxel along the normal, mm
};

double squareToLine(glm::dvec3 p, glm::dvec3 from, glm::dvec3 to) {
  const glm::dvec3 along = to - from;
  const double square = glm::dot(along, along);
  const double t = square > 0 ? std::clamp(glm::dot(p - from, along) / square, 0.0, 1.0) : 0;
  const glm::dvec3 away = p - (from + t * along);
  return glm::dot(away, away);
}

// Adds one disc; its runs may overlap those already in `spans`.
void addDisc(VoxelSpans& spans, const VoxelGeometry& grid, const CutByPlane& cut, glm::dvec3 middle,
             glm::dvec3 normal, double radiusMm) {
  const glm::dvec3 edges = grid.spacing(), place = grid.voxelFromPatient(middle);
  const double finest = std::min({edges.x, edges.y, edges.z}), most = radiusMm * (1 + brushRounding);
  const glm::dvec3 core = 0.5 - 0.5 * finest / edges;  // half extents of the inner box within a voxel
  forRows(boxOfStroke(grid, middle, middle, radiusMm + finest), [&](int j, int k, RowRange range) {
    cut.narrow(j, k, range);
    addRow(spans, j, k, range, [&](int i) {
      if (!cut.cuts({i, j, k})) return false;
      const glm::dvec3 from = place - glm::dvec3(i, j, k);
      glm::dvec3 way = grid.patientFromVoxelStep * (from - glm::clamp(from, -core, core));
      way -= glm::dot(way, normal) * normal;
      return glm::dot(way, way) <= most * most;
    });
  });
}

}  // namespace

VoxelSpans ballStroke(const VoxelGeometry& grid, glm::dvec3 from, glm::dvec3 to, double radiusMm) {
  const double length = glm::distance(from, to), square = radiusMm * radiusMm * (1 + brushRounding);
  const glm::dvec3 along = length > 0 ? (to - from) / length : glm::dvec3(0);
  const auto across = [&](glm::dvec3 way) { return way - glm::dot(way, along) * along; };
  const glm::dvec3 step = grid.patientFromVoxelStep[0], stepAcross = across(step);
  const double a = glm::dot(stepAcross, stepAcross);
  VoxelSpans spans;
  forRows(boxOfStroke(grid, from, to, radiusMm), [&](int j, int k, RowRange range) {
    const glm::dvec3 first = grid.patientFromVoxel({0, j, k});
    // Restricts the row to radiusMm around the infinite line.
    if (a > 1e-9 * glm::dot(step, step)) {
      const glm::dvec3 out = across(first - from);
      const double middle = -glm::dot(out, stepAcross) / a,
                   reach = square - (glm::dot(out, out) - a * middle * middle);
      if (reach < -brushRounding * square) return;
      const double half = std::sqrt(std::max(0.0, reach) / a) + 1e-3;
      range.keepWhere(0, 1, middle - half, middle + half);
    }
    addRow(spans, j, k, range,
           [&](int i) { return squareToLine(first + double(i) * step, from, to) <= square; });
  });
  return spans;
}

VoxelSpans discStroke(const VoxelGeometry& grid, glm::dvec3 from, glm::dvec3 to, glm::dvec3 normal,
                      double radiusMm) {
  const glm::dvec3 edges = grid.spacing(), unit = glm::normalize(normal);
  const double apart = std::min({edges.x, edges.y, edges.z}) / 2;
  const CutByPlane cut(grid, from, unit);
  const int steps = int(std::ceil(glm::distance(from, to) / apart));
  VoxelSpans spans;
  for (int n = 0; n <= steps; ++n)
    addDisc(spans, grid, cut, glm::mix(from, to, steps > 0 ? double(n) / steps : 0.0), unit, radiusMm);
  return mergedSpans(std::move(spans));
}

VoxelSpans insideOutline(const VoxelGeometry& grid, std::span<const glm::dvec3> outline, glm::dvec3 normal) {
  VoxelSpans spans;
  if (outline.size() < 3) return spans;
  const glm::dvec3 unit = glm::normalize(normal), origin = outline.front();
  const glm::dvec3 aside = std::abs(unit.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(unit, aside)), down = glm::cross(unit, right);
  const auto inPlane = [&](glm::dvec3 p) {
    return glm::dvec2(glm::dot(p - origin, right), glm::dot(p - origin, down));
  };
  std::vector<glm::dvec2> points;
  double reach = 0;
  for (const glm::dvec3& p : outline) {
    points.push_back(inPlane(p));
    reach = std::max(reach, glm::length(points.back()));
  }
  const CutByPlane cut(grid, origin, unit);
  const ClosedOutline closed(points);
  forRows(boxOfStroke(grid, origin, origin, reach), [&](int j, int k, RowRange range) {
    cut.narrow(j, k, range);
    addRow(spans, j, k, range, [&](int i) {
      return cut.cuts({i, j, k}) && closed.holds(inPlane(grid.patientFromVoxel({i, j, k})));
    });
  });
  return spans;
}

LabelMap painted(const LabelMap& map, const VoxelSpans& spans, const PaintRules& rules) {
  std::array<bool, 256> isKept{};
  for (const std::uint8_t label : rules.kept) isKept[label] = true;
  const auto& padding = rules.volume ? rules.volume->attributes().padding : std::nullopt;
  const auto isValueMeant = [&](glm::ivec3 v) {
    if (!rules.range || !rules.volume) return true;
    const double value = rules.volume->value(v.x, v.y, v.z);
    return holds(*rules.range, value) && !isPadding(padding, value);
  };
  LabelEdit edit(map);
  for (const RowSpan& span : spans)
    for (glm::ivec3 v(span.begin, span.j, span.k); v.x < span.end; ++v.x) {
      const std::uint8_t label = edit.at(v);
      const bool isMeant = rules.erases ? label == rules.label : label != rules.label;
      if (isMeant && !isKept[label] && isValueMeant(v)) edit.set(v, rules.erases ? 0 : rules.label);
    }
  return edit.done();
}

void addSpans(BitMask& mask, const VoxelSpans& spans) {
  for (const RowSpan& span : spans)
    for (glm::ivec3 v(span.begin, span.j, span.k); v.x < span.end; ++v.x) mask.set(v);
}

}  // namespace volumen
