#include "viewer/render/caches.h"

#include <algorithm>

#include "viewer/plan/visibility.h"
#include "viewer/volume/float_units.h"
#include "viewer/volume/parallel.h"

namespace volumen {

RenderCaches::RenderCaches(VolumePtr volume) : impl_(std::make_unique<Impl>()) {
  impl_->volume = std::move(volume);
}
RenderCaches::~RenderCaches() = default;
RenderCaches::RenderCaches(RenderCaches&&) noexcept = default;
RenderCaches& RenderCaches::operator=(RenderCaches&&) noexcept = default;

const VolumePtr& RenderCaches::volume() const { return impl_->volume; }
const VolumeFacts& RenderCaches::facts() { return impl_->factsOfVolume(); }

void RenderCaches::setGlContextFactory(GlContextFactory factory) {
  impl_->gl.reset();
  impl_->glFactory = std::move(factory);
}

namespace {

// A copy of the samples, each turned into a T by `convert`, on all cores.
template <class T, class From, class Convert>
Buffer<T> converted(const std::vector<From>& stored, Convert convert) {
  Buffer<T> out(stored.size());
  constexpr std::int64_t chunk = 1 << 18;
  const std::int64_t count = std::int64_t(stored.size());
  parallelFor((count + chunk - 1) / chunk, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin * chunk; n < std::min(count, end * chunk); ++n) out[n] = convert(stored[n]);
  });
  return out;
}

// Which blocks that are `times` as large along each edge hold one that is visible.
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

const VolumeFacts& RenderCaches::Impl::factsOfVolume() {
  if (!facts) facts = factsOf(*volume);
  return *facts;
}

const Density16& RenderCaches::Impl::densities16() {
  if (density16) return *density16;
  const double slope = volume->slope();
  Density16 d;
  d.scale = {slope, volume->intercept(), 0, 0};
  // A kernel reads a voxel and its neighbour along i in one load; with one voxel along i that would read past
  // the end of the samples.
  const bool ownSamples = volume->size().x > 1;
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        if constexpr (std::is_same_v<T, float>) {
          return;
        } else if (sizeof(T) == 2 && ownSamples) {
          d.data = reinterpret_cast<const std::int16_t*>(stored.data());
          if (std::is_same_v<T, std::uint16_t>) d.flip = 0x80008000u;
        } else {
          const int shift = std::is_same_v<T, std::uint16_t> ? 32768 : 0;
          d.copy = converted<std::int16_t>(stored, [&](T v) { return std::int16_t(int(v) - shift); });
          d.data = d.copy.data();
        }
        if (std::is_same_v<T, std::uint16_t>) d.scale.intercept += 32768 * slope;
      },
      volume->stored());
  const ValueRange range = factsOfVolume().range;
  d.scale.low = (range.low - d.scale.intercept) / slope;
  d.scale.high = (range.high - d.scale.intercept) / slope;
  return density16.emplace(std::move(d));
}

const Density32& RenderCaches::Impl::densities32() {
  if (density32) return *density32;
  Density32 d;
  const ValueRange range = factsOfVolume().range;
  const FloatUnits units = floatUnits(range);
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        if constexpr (std::is_same_v<T, float>) d.data = stored.data();
        if (d.data && units == FloatUnits()) return;
        d.copy = converted<float>(stored, [&](T v) { return inUnits(volume->realValue(v), units); });
        d.data = d.copy.data();
      },
      volume->stored());
  d.scale = {units.slope, units.intercept, (range.low - units.intercept) / units.slope,
             (range.high - units.intercept) / units.slope};
  return density32.emplace(std::move(d));
}

const Density8& RenderCaches::Impl::densitiesIn8() {
  if (!density8) density8 = densities8(*volume, byteScale(*volume, factsOfVolume().range));
  return *density8;
}

const Gradients16& RenderCaches::Impl::gradientsIn16(GradientOperator by) {
  if (!gradients16 || gradients16->by != by) {
    gradients16.reset();  // not two at a time
    gradients16 = {by, gradients16By(*volume, by)};
  }
  return gradients16->gradients;
}

const Gradients32& RenderCaches::Impl::gradientsIn32(GradientOperator by) {
  if (!gradients32 || gradients32->by != by) {
    gradients32.reset();
    gradients32 = {by, gradients32By(*volume, by)};
  }
  return gradients32->gradients;
}

const Voxels8& RenderCaches::Impl::voxelsIn8(GradientOperator by) {
  if (!voxels8 || voxels8->by != by) {
    voxels8.reset();
    voxels8 = {by, voxels8By(*volume, by, byteScale(*volume, factsOfVolume().range))};
  }
  return voxels8->gradients;
}

const RenderCaches::Impl::Skip& RenderCaches::Impl::skipOf(const TransferFunction& curve,
                                                           const CurveTable& table, const SkipWish& wish) {
  if (skips[0].made.densities != wish.densities) std::swap(skips[0], skips[1]);
  Skip& skip = skips[0];
  // Another view may ask for another reach, but not for other blocks or cells.
  SkipWish others = skip.made;
  others.reachBlocks = wish.reachBlocks;
  others.cells = wish.cells;
  const bool sameBlocks = others == wish;
  // Cells that were looked into stay, also where a kernel in between does not ask.
  const bool hasCells = sameBlocks && skip.made.cells;
  auto& maps = skip.maps;
  if (!sameBlocks) maps[0].near.clear(), maps[1].near.clear();
  const auto has = [&](const SkipMap& m) { return m.reach == wish.reachBlocks && !m.near.empty(); };
  if (!has(maps[0])) std::swap(maps[0], maps[1]);
  skip.made = wish;
  skip.made.cells = hasCells;
  if (has(maps[0]) && (hasCells || !wish.cells)) return skip;
  const VolumeFacts& known = factsOfVolume();
  const BrickRanges& bricks = *known.bricks;
  std::vector<std::uint8_t> visible = visibleBlocks(curve, bricks, wish.rounding);
  if (!has(maps[0]))
    maps[0] = makeSkipMap(bricks.edge, bricks.count, visible, wish.reachBlocks, std::move(maps[0]));
  if (wish.cells && !hasCells)
    skip.cells.begin(volume->size(), wish.densities, table,
                     inLargerBlocks(std::move(visible), bricks.count, VisibleCells::edge / bricks.edge));
  skip.made.cells |= wish.cells;
  return skip;
}

const ReflectanceMap& RenderCaches::Impl::reflectanceMap(const Lighting& lighting, int n, MapLookup lookup) {
  Lighting inputs = mapInputs(lighting);
  if (!map || map->inputs != inputs || map->map.n != n || map->lookup != lookup)
    map = Map{std::move(inputs), lookup, makeReflectanceMap(lighting, n, lookup)};
  return map->map;
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
