#include "viewer/segment/segmentation.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "viewer/volume/parallel.h"

namespace volumen {
namespace {

/// A frame and its position along the normal, mm.
struct Plane {
  double along;
  std::size_t frame;
};

std::vector<Plane> planesOf(const Segmentation& s) {
  const glm::dvec3 normal = glm::cross(s.right, s.down);
  std::vector<Plane> planes;
  for (std::size_t n = 0; n < s.frames.size(); ++n)
    planes.push_back({glm::dot(s.frames[n].origin, normal), n});
  std::ranges::sort(planes, {}, &Plane::along);
  return planes;
}

/// The mask of a segment on the grid and on the acquired slices.
struct TwoMasks {
  BitMask drawn;
  std::optional<BitMask> onSlices;
};

bool shareVoxel(const BitMask& one, const BitMask& other) {
  const auto a = one.words(), b = other.words();
  for (std::size_t n = 0; n < a.size(); ++n)
    if (a[n] & b[n]) return true;
  return false;
}

/// A label map that segments are added to one by one.
struct SharedLabels {
  static constexpr int mostLabels = 255;
  std::vector<Segment> segments;
  LabelMap labels;
  std::optional<LabelMap> onSlices;
  TwoMasks taken;

  explicit SharedLabels(const TwoMasks& like)
      : labels(like.drawn.geometry()), taken{BitMask(like.drawn.geometry()), {}} {
    if (!like.onSlices) return;
    onSlices.emplace(like.onSlices->geometry());
    taken.onSlices.emplace(like.onSlices->geometry());
  }

  bool hasRoomFor(const TwoMasks& mask) const {
    return segments.size() < mostLabels && !shareVoxel(taken.drawn, mask.drawn) &&
           !(onSlices && shareVoxel(*taken.onSlices, *mask.onSlices));
  }
  bool isFree(int label) const {
    return label >= 1 && label <= mostLabels &&
           std::ranges::find(segments, label, &Segment::number) == segments.end();
  }
  void add(Segment segment, const TwoMasks& mask) {
    for (int label = 1; !isFree(segment.number); ++label) segment.number = label;
    const auto label = std::uint8_t(segment.number);
    labels = withLabel(labels, label, mask.drawn);
    taken.drawn = united(std::move(taken.drawn), mask.drawn);
    if (onSlices) {
      onSlices = withLabel(*onSlices, label, *mask.onSlices);
      taken.onSlices = united(std::move(*taken.onSlices), *mask.onSlices);
    }
    segments.push_back(std::move(segment));
  }
  Segmented made() && {
    Segmented all{std::move(segments), std::move(labels)};
    if (onSlices) all.acquired = std::make_shared<const AcquiredLabels>(AcquiredLabels{std::move(*onSlices)});
    return all;
  }
};

/// Returns the slice that a plane lies on, along k of the grid; empty if there is none.
std::optional<std::size_t> sliceAt(const Segmentation& s, glm::dvec3 origin, const VoxelGeometry& grid,
                                   const std::vector<double>& places) {
  constexpr double off = 0.02;  // fraction of the slice spacing
  const glm::dvec3 across = (s.size.x - 1) * s.mm.x * s.right, down = (s.size.y - 1) * s.mm.y * s.down;
  const double k = grid.voxelFromPatient(origin).z;
  for (const glm::dvec3& corner : {across, down})
    if (std::abs(grid.voxelFromPatient(origin + corner).z - k) > off) return {};
  for (std::size_t n = 0; n < places.size(); ++n)
    if (std::abs(places[n] - k) <= off) return n;
  return {};
}

/// Returns the slice of each frame; empty if any frame lies on none.
std::vector<std::size_t> slicesOf(const Segmentation& s, const VoxelGeometry& grid,
                                  const AcquiredSlices& slices) {
  std::vector<std::size_t> all;
  if (!slices.volume) return all;
  for (const SegmentFrame& frame : s.frames) {
    const auto slice = sliceAt(s, frame.origin, grid, slices.places);
    if (!slice) return {};
    all.push_back(*slice);
  }
  return all;
}

/// Returns a segment on the slices of its frames.
BitMask maskOnSlices(const Segmentation& s, std::size_t segment, const VoxelGeometry& grid,
                     const AcquiredSlices& slices, const std::vector<std::size_t>& sliceOf) {
  BitMask mask(slices.volume->geometry());
  const SegmentPlaces places(s, segment);
  for (std::size_t n = 0; n < s.frames.size(); ++n) {
    if (s.frames[n].segment != segment) continue;
    VoxelGeometry plane = grid;
    plane.size.z = 1;
    plane.origin = grid.patientFromVoxel({0, 0, slices.places[sliceOf[n]]});
    BitMask one(plane);
    places.fill(one, 0);
    for (int j = 0; j < mask.size().y; ++j)
      std::ranges::copy(one.row(j, 0), mask.row(j, int(sliceOf[n])).begin());
  }
  return mask;
}

TwoMasks twoMasks(BitMask onSlices, const AcquiredSlices& slices, const VoxelGeometry& grid) {
  BitMask drawn = fromAcquired(onSlices, slices, grid);
  return {std::move(drawn), std::move(onSlices)};
}

}  // namespace

std::int64_t pixelsOf(const Segmentation& s, std::size_t segment) {
  std::int64_t count = 0;
  for (std::size_t n = 0; n < s.frames.size(); ++n)
    for (int y = 0; y < s.size.y && s.frames[n].segment == segment; ++y)
      for (int x = 0; x < s.size.x; ++x) count += s.isSet(n, x, y);
  return count;
}

Result<VoxelGeometry> gridOf(const Segmentation& s) {
  constexpr double same = 1e-3, off = 0.05;  // mm; fraction of a step
  constexpr double mostVoxels = 2147483647;
  const std::vector<Plane> planes = planesOf(s);
  if (planes.empty()) return Error{"the segmentation has no frames"};
  double step = HUGE_VAL;
  for (std::size_t n = 1; n < planes.size(); ++n)
    if (const double gap = planes[n].along - planes[n - 1].along; gap > same) step = std::min(step, gap);
  if (!std::isfinite(step)) step = s.thickness;
  const Plane& first = planes.front();
  const double last = std::round((planes.back().along - first.along) / step);
  if (!(double(s.size.x) * s.size.y * (last + 1) <= mostVoxels))
    return Error{"the grid of the segmentation has 2^31 voxels or more"};
  const glm::dvec3 normal = glm::cross(s.right, s.down), origin = s.frames[first.frame].origin;
  for (const Plane& plane : planes) {
    const double k = (plane.along - first.along) / step;
    const glm::dvec3 expected = origin + std::round(k) * step * normal;
    if (std::abs(k - std::round(k)) > off ||
        glm::distance(s.frames[plane.frame].origin, expected) > off * (step + std::max(s.mm.x, s.mm.y)))
      return Error{"the frames of the segmentation do not lie on an even grid"};
  }
  VoxelGeometry grid;
  grid.size = {s.size.x, s.size.y, int(last) + 1};
  grid.patientFromVoxelStep = {s.right * s.mm.x, s.down * s.mm.y, normal * step};
  grid.origin = origin;
  return grid;
}

SegmentPlaces::SegmentPlaces(const Segmentation& segmentation, std::size_t segment)
    : all_(segmentation), normal_(glm::cross(segmentation.right, segmentation.down)) {
  for (std::size_t n = 0; n < all_.frames.size(); ++n)
    if (all_.frames[n].segment == segment) planes_.push_back({glm::dot(all_.frames[n].origin, normal_), n});
  std::ranges::sort(planes_, {}, &Plane::along);
}

const SegmentPlaces::Plane* SegmentPlaces::planeAt(double along) const {
  constexpr double touching = 1e-6;  // tolerance for points on the face between two planes
  if (planes_.empty()) return nullptr;
  auto plane = std::ranges::lower_bound(planes_, along, {}, &Plane::along);
  if (plane == planes_.end() || (plane != planes_.begin() && along - plane[-1].along < plane->along - along))
    --plane;
  return std::abs(plane->along - along) > all_.thickness / 2 * (1 + touching) ? nullptr : &*plane;
}

SegmentPlaces::Pixel SegmentPlaces::pixelOf(const Plane& plane, glm::dvec3 p) const {
  const glm::dvec3 from = p - all_.frames[plane.frame].origin;
  return {plane.frame, {glm::dot(from, all_.right) / all_.mm.x, glm::dot(from, all_.down) / all_.mm.y}};
}

std::optional<SegmentPlaces::Pixel> SegmentPlaces::pixelAt(glm::dvec3 p) const {
  const Plane* plane = planeAt(glm::dot(p, normal_));
  return plane ? std::optional(pixelOf(*plane, p)) : std::nullopt;
}

bool SegmentPlaces::isSet(const Pixel& pixel) const {
  const double x = std::floor(pixel.at.x + 0.5), y = std::floor(pixel.at.y + 0.5);
  return x >= 0 && y >= 0 && x < all_.size.x && y < all_.size.y && all_.isSet(pixel.frame, int(x), int(y));
}

bool SegmentPlaces::holds(glm::dvec3 p) const {
  const auto pixel = pixelAt(p);
  return pixel && isSet(*pixel);
}

// If the line runs within a plane, the nearest plane is constant and the pixel position is linear.
void SegmentPlaces::holdsAlong(glm::dvec3 pFirst, glm::dvec3 step, std::span<std::uint8_t> held) const {
  const auto placeOf = [&](std::size_t n) { return pFirst + double(n) * step; };
  if (std::abs(glm::dot(step, normal_)) * double(held.size()) > 1e-9) {
    for (std::size_t n = 0; n < held.size(); ++n) held[n] = holds(placeOf(n));
    return;
  }
  std::ranges::fill(held, std::uint8_t(0));
  const auto first = pixelAt(pFirst);
  if (!first) return;
  const glm::dvec2 on(glm::dot(step, all_.right) / all_.mm.x, glm::dot(step, all_.down) / all_.mm.y);
  for (std::size_t n = 0; n < held.size(); ++n) held[n] = isSet({first->frame, first->at + double(n) * on});
}

// Checking the corners of a slice suffices, because positions are linear and the region nearest to a plane
// is convex.
std::optional<std::size_t> SegmentPlaces::frameOn(const VoxelGeometry& grid, int k) const {
  constexpr double off = 0.49;  // less than half a pixel
  if (glm::ivec2(grid.size) != all_.size) return {};
  std::optional<std::size_t> frame;
  for (const int x : {0, grid.size.x - 1})
    for (const int y : {0, grid.size.y - 1}) {
      const auto pixel = pixelAt(grid.patientFromVoxel({x, y, k}));
      if (!pixel || (frame && *frame != pixel->frame)) return {};
      frame = pixel->frame;
      const glm::dvec2 from = glm::abs(pixel->at - glm::dvec2(x, y));
      if (!(std::max(from.x, from.y) < off)) return {};
    }
  return frame;
}

void SegmentPlaces::fill(BitMask& mask, int k) const {
  const VoxelGeometry& grid = mask.geometry();
  if (planes_.empty()) return;
  const auto frame = frameOn(grid, k);
  for (int j = 0; j < grid.size.y; ++j) {
    const auto row = mask.row(j, k);
    if (frame) {
      unpackWords(all_.bits, all_.rowAt(*frame, j), std::size_t(grid.size.x), row);
      continue;
    }
    for (int i = 0; i < grid.size.x; ++i)
      if (holds(grid.patientFromVoxel({i, j, k}))) row[std::size_t(i) / 64] |= std::uint64_t(1) << i % 64;
  }
}

std::vector<glm::dvec3> SegmentPlaces::corners() const {
  std::vector<glm::dvec3> corners;
  if (planes_.empty()) return corners;
  const double half = all_.thickness / 2;
  for (const auto& [plane, side] : {std::pair(planes_.front(), -half), std::pair(planes_.back(), half)})
    for (const double x : {-0.5, all_.size.x - 0.5})
      for (const double y : {-0.5, all_.size.y - 0.5})
        corners.push_back(all_.frames[plane.frame].origin + x * all_.mm.x * all_.right +
                          y * all_.mm.y * all_.down + side * normal_);
  return corners;
}

BitMask maskOf(const Segmentation& s, std::size_t segment, const VoxelGeometry& grid,
               const CancelToken& cancel) {
  BitMask mask(grid);
  const SegmentPlaces places(s, segment);
  parallelFor(grid.size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end && !cancel.cancelled(); ++k) places.fill(mask, int(k));
  });
  return mask;
}

std::vector<Segmented> segmentedOf(const Segmentation& s, const VoxelGeometry& grid,
                                   const CancelToken& cancel, const AcquiredSlices& slices) {
  const std::vector<std::size_t> sliceOf = slicesOf(s, grid, slices);
  std::vector<SharedLabels> maps;
  for (std::size_t n = 0; n < s.segments.size() && !cancel.cancelled(); ++n) {
    const TwoMasks mask = sliceOf.empty() ? TwoMasks{maskOf(s, n, grid, cancel), {}}
                                          : twoMasks(maskOnSlices(s, n, grid, slices, sliceOf), slices, grid);
    auto map = std::ranges::find_if(maps, [&](const SharedLabels& m) { return m.hasRoomFor(mask); });
    if (map == maps.end()) map = maps.insert(map, SharedLabels(mask));
    map->add(s.segments[n], mask);
  }
  std::vector<Segmented> all;
  for (SharedLabels& map : maps) all.push_back(std::move(map).made());
  return all;
}

}  // namespace volumen
