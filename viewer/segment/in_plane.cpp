#include "viewer/segment/in_plane.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "viewer/segment/bit_rows.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using glm::dvec2, glm::dvec3, glm::i64vec2;

// Positions in a slice in half voxels, so that midpoints between pixels are integers.
using HalfPlace = i64vec2;

// Coordinates of a slice in mm; i runs along x.
class SlicePlaneMm {
 public:
  explicit SlicePlaneMm(const VoxelGeometry& grid) : grid_(grid) {
    const dvec3 i = grid.patientFromVoxelStep[0], j = grid.patientFromVoxelStep[1];
    const dvec3 x = glm::normalize(i), y = glm::normalize(j - glm::dot(j, x) * x);
    i_ = {glm::length(i), 0};
    j_ = {glm::dot(j, x), glm::dot(j, y)};
  }
  dvec2 mm(HalfPlace p) const { return (double(p.x) * i_ + double(p.y) * j_) / 2.0; }
  // Converts a position in mm in the plane to voxels.
  dvec2 voxels(dvec2 mm) const {
    const double j = mm.y / j_.y;
    return {(mm.x - j * j_.x) / i_.x, j};
  }
  dvec3 patient(dvec2 mm, int k) const { return grid_.patientFromVoxel(dvec3(voxels(mm), k)); }

 private:
  const VoxelGeometry& grid_;
  dvec2 i_, j_;
};

// Returns a row of the slice, or `nothing` beyond the grid.
bits::Row rowOf(const BitMask& mask, int j, int k, bits::Row nothing) {
  return j < 0 || j >= mask.size().y ? nothing : bits::Row(mask.row(j, k));
}

// Visits the first and last outline point of each half row, from top to bottom. They suffice for the convex
// hull.
template <class Visit>
void forEachEnd(const BitMask& mask, int k, const Visit& visit) {
  const std::vector<std::uint64_t> nothing(std::size_t(mask.wordsPerRow()));
  const auto firstAndLast = [](const auto& wordAt, std::size_t words, const auto& found) {
    std::int64_t first = -1, last = -1;
    for (std::size_t w = 0; w < words; ++w)
      if (const std::uint64_t word = wordAt(w)) {
        if (first < 0) first = std::int64_t(w) * 64 + std::countr_zero(word);
        last = std::int64_t(w) * 64 + 63 - std::countl_zero(word);
      }
    if (first >= 0) found(first, last);
  };
  for (int j = 0; j <= mask.size().y; ++j) {
    const bits::Row before = rowOf(mask, j - 1, k, nothing), row = rowOf(mask, j, k, nothing);
    firstAndLast([&](std::size_t w) { return before[w] ^ row[w]; }, row.size(),
                 [&](std::int64_t first, std::int64_t last) {
                   visit(HalfPlace(2 * first, 2 * j - 1)), visit(HalfPlace(2 * last, 2 * j - 1));
                 });
    firstAndLast([&](std::size_t w) { return row[w]; }, row.size(),
                 [&](std::int64_t first, std::int64_t last) {
                   visit(HalfPlace(2 * first - 1, 2 * j)), visit(HalfPlace(2 * last + 1, 2 * j));
                 });
  }
}

// Returns the convex hull of points sorted by y, then x (Andrew 1979).
std::vector<HalfPlace> convexHull(const std::vector<HalfPlace>& places) {
  std::vector<HalfPlace> hull;
  const auto add = [&](HalfPlace p, std::size_t from) {
    const auto turns = [&] {
      const HalfPlace a = hull[hull.size() - 2], b = hull.back() - a, c = p - a;
      return b.x * c.y - b.y * c.x > 0;
    };
    while (hull.size() >= from + 2 && !turns()) hull.pop_back();
    hull.push_back(p);
  };
  for (const HalfPlace& p : places) add(p, 0);
  const std::size_t turn = hull.size() - 1;
  for (auto p = places.rbegin() + 1; p < places.rend(); ++p) add(*p, turn);
  return hull;
}

// The two farthest points of a slice and their distance; -1 if there are none.
struct FarPlaces {
  double mm = -1;
  HalfPlace from{0}, to{0};
};

FarPlaces farthestOf(const BitMask& mask, int k, const SlicePlaneMm& plane) {
  std::vector<HalfPlace> ends;
  forEachEnd(mask, k, [&](HalfPlace p) {
    if (ends.empty() || ends.back() != p) ends.push_back(p);
  });
  FarPlaces far;
  if (ends.empty()) return far;
  const std::vector<HalfPlace> hull = convexHull(ends);
  for (std::size_t a = 0; a < hull.size(); ++a)
    for (std::size_t b = a + 1; b < hull.size(); ++b)
      if (const double mm = glm::length(plane.mm(hull[b] - hull[a])); mm > far.mm)
        far = {mm, hull[a], hull[b]};
  return far;
}

// Visits both ends of each outline segment. Pixels that touch only at a corner are separated.
template <class Visit>
void forEachPiece(const BitMask& mask, int k, const Visit& visit) {
  const std::vector<std::uint64_t> nothing(std::size_t(mask.wordsPerRow()));
  for (int j = 0; j <= mask.size().y; ++j) {
    const bits::Row before = rowOf(mask, j - 1, k, nothing), row = rowOf(mask, j, k, nothing);
    for (int i = 0; i <= mask.size().x; ++i) {
      const auto isIn = [&](bits::Row of, int at) {
        return at >= 0 && at < mask.size().x && bits::isSet(of, at);
      };
      const bool a = isIn(before, i - 1), b = isIn(before, i), c = isIn(row, i - 1), d = isIn(row, i);
      if (a == b && a == c && a == d) continue;
      const HalfPlace top(2 * i - 1, 2 * j - 2), bottom(2 * i - 1, 2 * j), left(2 * i - 2, 2 * j - 1),
          right(2 * i, 2 * j - 1);
      if (a == d && b == c) {
        visit(top, a ? left : right), visit(bottom, a ? right : left);
        continue;
      }
      HalfPlace ends[2];
      std::size_t count = 0;
      for (const auto& [isCrossed, place] :
           {std::pair(a != b, top), {c != d, bottom}, {a != c, left}, {b != d, right}})
        if (isCrossed) ends[count++] = place;
      visit(ends[0], ends[1]);
    }
  }
}

// An outline segment in coordinates along (x) and across (y) a direction, smaller x first.
struct OutlinePiece {
  dvec2 first, last;
};

// Returns the longest line across a direction between the segments. Its length is linear between outline
// corners, so the longest line starts or ends at a corner.
InPlaneDiameters::Line longestAcross(std::vector<OutlinePiece> pieces, const SlicePlaneMm& plane, dvec2 along,
                                     int k) {
  std::ranges::sort(pieces, {}, [](const OutlinePiece& piece) {
    return std::array{piece.first.x, piece.first.y, piece.last.x, piece.last.y};
  });
  double widest = 0;
  for (const OutlinePiece& piece : pieces) widest = std::max(widest, piece.last.x - piece.first.x);
  double at = 0, low = 0, high = -1;
  const auto tryAt = [&](double x) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    const auto add = [&](double y) { least = std::min(least, y), most = std::max(most, y); };
    auto piece =
        std::ranges::lower_bound(pieces, x - 1.001 * widest, {}, [](const auto& p) { return p.first.x; });
    for (; piece != pieces.end() && piece->first.x <= x; ++piece) {
      if (piece->last.x < x) continue;
      const double width = piece->last.x - piece->first.x;
      if (width == 0) add(piece->first.y);
      add(width == 0 ? piece->last.y
                     : piece->first.y + (x - piece->first.x) / width * (piece->last.y - piece->first.y));
    }
    if (most - least > high - low) at = x, low = least, high = most;
  };
  for (const OutlinePiece& piece : pieces) tryAt(piece.first.x), tryAt(piece.last.x);
  const dvec2 across(-along.y, along.x);
  return {high - low,
          {plane.patient(at * along + low * across, k), plane.patient(at * along + high * across, k)}};
}

}  // namespace

std::optional<InPlaneDiameters> inPlaneDiameters(const BitMask& mask, const CancelToken& cancel) {
  const SlicePlaneMm plane(mask.geometry());
  std::vector<FarPlaces> ofSlices(std::size_t(mask.size().z));
  parallelFor(mask.size().z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end && !cancel.cancelled(); ++k)
      ofSlices[std::size_t(k)] = farthestOf(mask, int(k), plane);
  });
  const auto far = std::ranges::max_element(ofSlices, {}, &FarPlaces::mm);
  if (far->mm < 0) return {};
  InPlaneDiameters found;
  found.slice = int(far - ofSlices.begin());
  const dvec2 from = plane.mm(far->from), to = plane.mm(far->to);
  found.longest = {far->mm, {plane.patient(from, found.slice), plane.patient(to, found.slice)}};
  const dvec2 along = glm::normalize(to - from), across(-along.y, along.x);
  std::vector<OutlinePiece> pieces;
  forEachPiece(mask, found.slice, [&](HalfPlace a, HalfPlace b) {
    const auto turned = [&](HalfPlace p) {
      return dvec2(glm::dot(plane.mm(p), along), glm::dot(plane.mm(p), across));
    };
    OutlinePiece piece{turned(a), turned(b)};
    if (piece.first.x > piece.last.x) std::swap(piece.first, piece.last);
    pieces.push_back(piece);
  });
  found.perpendicular = longestAcross(std::move(pieces), plane, along, found.slice);
  return found;
}

}  // namespace volumen
