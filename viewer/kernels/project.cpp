#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/kernels/project.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <optional>

#include "viewer/kernels/blocks_along_ray-inl.h"
#include "viewer/kernels/bytes-inl.h"
#include "viewer/kernels/projection-inl.h"
#include "viewer/kernels/skip_samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

template <class Store, Mode kMode>
void ProjectSamples(const RayInputs& f, const BlockValues& blocks, const RayRow& rays,
                    const PlaneBuffer& plane, float* result, TraceCounts& counts) {
  const Grid grid(f, f.densityRow);
  std::vector<SampleRun> runs;
  for (std::size_t first = 0; first < rays.steps.size(); first += hn::Lanes(DF())) {
    SampleProjection<Store, kMode> packet(f, grid, rays, plane, int(first));
    if constexpr (!std::is_void_v<Store> && kMode != Mode::average)
      if (blocks.blockRanges) {
        counts.resampled += TakeExtremes(f, blocks, packet, runs);
        hn::StoreU(packet.Result(), DF(), result + first);
        continue;
      }
    for (int step = 0; step < packet.Rays().longest; ++step) counts.resampled += packet.Take(step);
    hn::StoreU(packet.Result(), DF(), result + first);
  }
}

template <class Store, Mode kMode>
void ProjectCells(const RayInputs& f, const BlockValues& blocks, const RayRow& rays, const PlaneBuffer&,
                  float* result, TraceCounts& counts) {
  const Grid grid(f, f.densityRow);
  std::optional<BlocksAlongRay<kMode>> blocksAlong;
  if (kMode != Mode::average && blocks.blockRanges && blocks.blockRanges->size() >= 4)
    blocksAlong.emplace(blocks, f.size);
  for (std::size_t first = 0; first < rays.steps.size(); first += hn::Lanes(DF())) {
    CellProjection<Store, kMode> packet(f, grid, rays, int(first));
    if (blocksAlong) {
      counts.resampled += blocksAlong->Take(packet);
    } else {
      VF at = hn::Zero(DF());
      counts.resampled += packet.Take(at, EndOf(packet.Rays()), 0);
    }
    hn::StoreU(packet.Result(), DF(), result + first);
  }
}

template <class Store, Mode kMode>
ProjectKernel ChooseWay(bool cellByCell) {
  if constexpr (!std::is_void_v<Store>)
    if (cellByCell) return ProjectCells<Store, kMode>;
  return ProjectSamples<Store, kMode>;
}

template <class Store>
ProjectKernel ChooseMode(Mode mode, bool cellByCell) {
  switch (mode) {
    case Mode::mip:
      return ChooseWay<Store, Mode::mip>(cellByCell);
    case Mode::minip:
      return ChooseWay<Store, Mode::minip>(cellByCell);
    case Mode::average:
      return ChooseWay<Store, Mode::average>(cellByCell);
    case Mode::composite:
      break;
  }
  return nullptr;  // Composites use chooseTraceKernel.
}

ProjectKernel ChooseProject(Store store, Mode mode, bool cellByCell) {
  return store == Store::int16     ? ChooseMode<Int16Store>(mode, cellByCell)
         : store == Store::float32 ? ChooseMode<Float32Store>(mode, cellByCell)
         : store == Store::byte1   ? ChooseMode<Byte1Store>(mode, cellByCell)
                                   : ChooseMode<void>(mode, cellByCell);
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(ChooseProject);

ProjectKernel chooseProjectKernel(Store store, Mode mode, bool cellByCell) {
  return HWY_DYNAMIC_DISPATCH(ChooseProject)(store, mode, cellByCell);
}

}  // namespace volumen
#endif  // HWY_ONCE
