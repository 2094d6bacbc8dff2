// The composite kernels of one store, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_TRACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_TRACE_INL_H_
#undef VOLUMEN_RENDER_KERNELS_TRACE_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_TRACE_INL_H_
#endif

#include <limits>

#include "viewer/render/kernels/sparse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// One kernel. All packets of the row advance together, a slab of steps at a time: what one brings into the
/// cache the others find there. (A packet alone, marching across rows of 512 voxels, throws its own lines out
/// again: they are a power of two apart.)
template <class Tracer>
void TraceRays(const TraceFrame& f, const RayRow& rays, const PlaneBuffer& plane, const TraceRow& out,
               TraceCounts& counts) {
  const std::int64_t begin = Ticks();
  const int lanes = int(hn::Lanes(DF())), packets = int(rays.steps.size()) / lanes;
  Tracer tracer(f, rays, plane, out, counts);
  std::vector<Skipper> skippers;
  skippers.reserve(packets);
  for (int n = 0; n < packets; ++n) skippers.emplace_back(f, LoadPacket(f, rays, n * lanes));
  const int longest = *std::max_element(rays.steps.begin(), rays.steps.end());
  constexpr int slab = Tracer::kSlab;
  std::vector<std::uint64_t> looks(packets);
  for (int step = 0; step < longest; step += slab) {
    glm::vec3 low(std::numeric_limits<float>::max()), high(0);
    for (int n = 0; n < packets; ++n) {
      // The skipper looks at as many steps at a time as a vector has lanes: those of several slabs, or of a
      // part.
      looks[n] = step % std::max(lanes, slab) ? looks[n] >> slab : 0;
      if (step % std::max(lanes, slab) == 0)
        for (int more = 0; more < std::max(lanes, slab); more += lanes)
          looks[n] |= skippers[n].LookFrom(step + more) << more;
      if (!tracer.IsOpen(n * lanes, step)) looks[n] = 0;
      if (Tracer::kCells && (looks[n] & ((1 << slab) - 1))) skippers[n].TakeIn(step, slab, low, high);
    }
    if (Tracer::kCells && f.cells && low.x <= high.x) f.cells->lookInto(low, high);
    tracer.BeginSlab();
    for (int n = 0; n < packets; ++n) tracer.Advance(n * lanes, step, looks[n] & ((1 << slab) - 1));
    tracer.EndSlab();
  }
  tracer.Finish();
  counts.allTicks += Ticks() - begin;
}

/// Whether a store has kernels of its own for frames in which most samples are visible.
template <class Store>
inline constexpr bool kDenseToo = true;

template <class Store, ShadeBy kShade, bool kGradientOpacity>
TraceKernel ChooseDensity(TraceKey key) {
  // What only studies ask for is not worth a kernel of its own.
  constexpr bool rare = kShade == ShadeBy::table || kShade == ShadeBy::mapNearest;
  if constexpr (std::is_void_v<Store> || rare) {
    return TraceRays<DenseTracer<Store, kShade, kGradientOpacity>>;
  } else {
    if (key.refined) return TraceRays<SparseTracer<Store, kShade, kGradientOpacity, true>>;
    if constexpr (kDenseToo<Store>)
      if (key.dense) return TraceRays<DenseTracer<Store, kShade, kGradientOpacity>>;
    return TraceRays<SparseTracer<Store, kShade, kGradientOpacity, false>>;
  }
}

template <class Store, ShadeBy kShade>
TraceKernel ChooseOpacity(TraceKey key) {
  return key.gradientOpacity ? ChooseDensity<Store, kShade, true>(key)
                             : ChooseDensity<Store, kShade, false>(key);
}

template <class Store>
TraceKernel ChooseShade(TraceKey key) {
  switch (key.shade) {
    case ShadeBy::map:
      return ChooseOpacity<Store, ShadeBy::map>(key);
    case ShadeBy::mapNearest:
      return ChooseOpacity<Store, ShadeBy::mapNearest>(key);
    case ShadeBy::table:
      return ChooseOpacity<Store, ShadeBy::table>(key);
    case ShadeBy::phong:
      return ChooseOpacity<Store, ShadeBy::phong>(key);
    case ShadeBy::local:
      return ChooseOpacity<Store, ShadeBy::local>(key);
    case ShadeBy::nothing:
      break;
  }
  return ChooseOpacity<Store, ShadeBy::nothing>(key);
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
