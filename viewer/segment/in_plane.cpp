#include "viewer/segment/in_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <utility>
#include <vector>

#include "viewer/segment/bit_rows.h"
#include "viewer/segment/runs.h"
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

// The two farthest points of a connected component in its slice and their distance; -1 if there are none.
struct FarPlaces {
  double mm = -1;
  HalfPlace from{0}, to{0};
  int slice = 0;
  std::uint32_t part = 0;
};

FarPlaces farthestOf(std::vector<HalfPlace> places, const SlicePlaneMm& plane) {
  std::ranges::sort(places, {}, [](HalfPlace p) { return std::array{p.y, p.x}; });
  places.erase(std::unique(places.begin(), places.end()), places.end());
  FarPlaces far;
  const std::vector<HalfPlace> hull = convexHull(places);
  for (std::size_t a = 0; a < hull.size(); ++a)
    for (std::size_t b = a + 1; b < hull.size(); ++b)
      if (const double mm = glm::length(plane.mm(hull[b] - hull[a])); mm > far.mm)
        far = {mm, hull[a], hull[b]};
  return far;
}

// Adds points at the ends of a run whose convex hull holds the outline about it.
void addEnds(const VoxelRun& run, int j, std::vector<HalfPlace>& places) {
  const std::int64_t first = 2 * std::int64_t(run.begin), last = 2 * std::int64_t(run.end - 1), y = 2 * j;
  for (const HalfPlace p :
       {HalfPlace(first - 1, y), {last + 1, y}, {first, y - 1}, {last, y - 1}, {first, y + 1}, {last, y + 1}})
    places.push_back(p);
}

// Returns the farthest points of slice `k` that lie in one component.
FarPlaces farthestIn(const JoinedRuns& joined, const VoxelGeometry& grid, int k, const SlicePlaneMm& plane) {
  std::map<std::uint32_t, std::vector<HalfPlace>> placesOf;
  for (int j = 0; j < grid.size.y; ++j) {
    const std::size_t row = std::size_t(k) * std::size_t(grid.size.y) + std::size_t(j);
    for (std::size_t n = joined.firstOfRow[row]; n < joined.firstOfRow[row + 1]; ++n)
      addEnds(joined.runs[n], j, placesOf[joined.runs[n].part]);
  }
  FarPlaces farthest;
  for (auto& [part, places] : placesOf)
    if (FarPlaces far = farthestOf(std::move(places), plane); far.mm > farthest.mm) {
      farthest = far;
      farthest.slice = k, farthest.part = part;
    }
  return farthest;
}

// Returns a row of the slice, or `nothing` beyond the grid.
bits::Row rowOf(const BitMask& mask, int j, int k, bits::Row nothing) {
  return j < 0 || j >= mask.size().y ? nothing : bits::Row(mask.row(j, k));
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
  constexpr RowStep inSlice[] = {{-1, 0, 0}};
  const VoxelGeometry& grid = mask.geometry();
  const SlicePlaneMm plane(grid);
  const JoinedRuns joined = joinedRuns(mask, inSlice, cancel);
  std::vector<FarPlaces> ofSlices(std::size_t(mask.size().z));
  parallelFor(mask.size().z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end && !cancel.cancelled(); ++k)
      ofSlices[std::size_t(k)] = farthestIn(joined, grid, int(k), plane);
  });
  const auto far = std::ranges::max_element(ofSlices, {}, &FarPlaces::mm);
  if (far->mm < 0) return {};
  InPlaneDiameters found;
  found.slice = far->slice;
  const dvec2 from = plane.mm(far->from), to = plane.mm(far->to);
  found.longest = {far->mm, {plane.patient(from, found.slice), plane.patient(to, found.slice)}};
  const dvec2 along = glm::normalize(to - from), across(-along.y, along.x);
  std::vector<bool> chosen(joined.parts);
  chosen[far->part] = true;
  std::vector<OutlinePiece> pieces;
  forEachPiece(maskOfRuns(joined, grid, chosen), found.slice, [&](HalfPlace a, HalfPlace b) {
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
