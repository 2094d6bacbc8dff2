#include "viewer/methods/caches.h"

#include <algorithm>

#include "viewer/kernels/make_reflectance_map.h"
#include "viewer/plan/visibility.h"
#include "viewer/volume/parallel.h"

namespace volumen {

RenderCaches::RenderCaches(VolumePtr volume)
    : RenderCaches(std::make_shared<StoredVoxels>(std::move(volume))) {}
RenderCaches::RenderCaches(std::shared_ptr<StoredVoxels> voxels)
    : impl_(std::make_unique<Impl>(std::move(voxels))) {}
RenderCaches::~RenderCaches() = default;
RenderCaches::RenderCaches(RenderCaches&&) noexcept = default;
RenderCaches& RenderCaches::operator=(RenderCaches&&) noexcept = default;

const VolumePtr& RenderCaches::volume() const { return impl_->voxels->volume(); }
const VolumeFacts& RenderCaches::facts() { return impl_->voxels->facts(); }

std::size_t RenderCaches::bytes() const {
  std::size_t sum = impl_->skips[0].bytes() + impl_->skips[1].bytes();
  if (impl_->map) sum += impl_->map->map.nodes.size() * sizeof(impl_->map->map.nodes[0]);
  for (const auto& cells : impl_->segmentCells) sum += cells->bytes();
  if (impl_->gl) sum += impl_->gl->textures.densityBytes() + impl_->gl->textures.gradientBytes();
  return sum;
}

void RenderCaches::setGlContextFactory(GlContextFactory factory) {
  impl_->gl.reset();
  impl_->glFactory = std::move(factory);
}

namespace {

// Returns which blocks, `times` as large along each edge, contain a visible block.
std::vector<std::uint8_t> inLargerBlocks(std::vector<std::uint8_t> visible, glm::ivec3 count, int times) {
  if (times == 1) return visible;
  const glm::ivec3 larger = (count + (times - 1)) / times;
  std::vector<std::uint8_t> out(std::size_t(larger.x) * larger.y * larger.z);
  std::size_t n = 0;
  for (int k = 0; k < count.z; ++k)
    for (int j = 0; j < count.y; ++j)
      for (int i = 0; i < count.x; ++i)
        out[(std::size_t(k / times) * larger.y + j / times) * larger.x + i / times] |= visible[n++];
  return out;
}

}  // namespace

const RenderCaches::Impl::Skip& RenderCaches::Impl::skipOf(const TransferFunction& curve,
                                                           const CurveTable& table,
                                                           const SkipRequest& request) {
  if (skips[0].made.densities != request.densities) std::swap(skips[0], skips[1]);
  Skip& skip = skips[0];
  // Another view may need another reach, but the same blocks and cells.
  SkipRequest others = skip.made;
  others.reachBlocks = request.reachBlocks;
  others.cells = request.cells;
  const bool sameBlocks = others == request;
  // Examined cells are kept, even if a kernel in between does not need them.
  const bool hasCells = sameBlocks && skip.made.cells;
  auto& maps = skip.maps;
  if (!sameBlocks) maps[0].near.clear(), maps[1].near.clear();
  const auto has = [&](const EmptySpaceMap& m) { return m.reach == request.reachBlocks && !m.near.empty(); };
  if (!has(maps[0])) std::swap(maps[0], maps[1]);
  skip.made = request;
  skip.made.cells = hasCells;
  if (has(maps[0]) && (hasCells || !request.cells)) return skip;
  const VolumeFacts& known = voxels->facts();
  const BlockRanges& blockRanges = *known.blockRanges;
  std::vector<std::uint8_t> visible = visibleBlocks(curve, blockRanges, request.rounding);
  if (!has(maps[0]))
    maps[0] = makeEmptySpaceMap(blockRanges.edge, blockRanges.count, visible, request.reachBlocks,
                                std::move(maps[0]));
  if (request.cells && !hasCells)
    skip.cells.begin(
        voxels->volume()->size(), request.densities, table,
        inLargerBlocks(std::move(visible), blockRanges.count, VisibleCells::edge / blockRanges.edge));
  skip.made.cells |= request.cells;
  return skip;
}

const ReflectanceMap& RenderCaches::Impl::reflectanceMap(const Lighting& lighting, int n, MapLookup lookup) {
  Lighting inputs = mapInputs(lighting);
  if (!map || map->inputs != inputs || map->map.n != n || map->lookup != lookup)
    map = Map{std::move(inputs), lookup, makeReflectanceMap(lighting, n, lookup)};
  return map->map;
}

const std::vector<std::shared_ptr<const SegmentCells>>& RenderCaches::Impl::segmentCellsOf(
    const std::vector<const SegmentSurface*>& segments) {
  std::vector<std::shared_ptr<const SegmentCells>> cells;
  for (const SegmentSurface* segment : segments) {
    const auto known =
        std::ranges::find(segmentCells, segment->field, [](const auto& c) { return c->field(); });
    cells.push_back(known != segmentCells.end() ? *known
                                                : std::make_shared<const SegmentCells>(segment->field));
  }
  segmentCells = std::move(cells);
  return segmentCells;
}

Result<GlState*> RenderCaches::Impl::glState() {
  if (!gl) {
    auto made = makeGlState(glFactory);
    if (!made) return made.error();
    gl = std::move(*made);
  }
  return gl.get();
}

}  // namespace volumen
