// The composite kernels of plain steps over one store, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_TRACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_TRACE_INL_H_
#undef VOLUMEN_RENDER_KERNELS_TRACE_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_TRACE_INL_H_
#endif

#include "viewer/render/kernels/batch-inl.h"
#include "viewer/render/kernels/slabs-inl.h"
#include "viewer/render/kernels/sparse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

template <class Store, ShadeBy kShade, bool kGradientOpacity>
TraceKernel ChooseDensity(TraceKey key) {
  if constexpr (std::is_void_v<Store> || isRare(kShade)) {
    return TraceRays<DenseTracer<Store, kShade, kGradientOpacity>>;
  } else {
    if constexpr (Store::kWhereFew == WhereFew::batches)
      if (key.cells) return TraceRays<BatchTracer<Store, kShade, kGradientOpacity>>;
    if constexpr (Store::kWhereFew == WhereFew::apart)
      if (key.cells) return TraceRays<SparseTracer<Store, kShade, kGradientOpacity>>;
    return TraceRays<DenseTracer<Store, kShade, kGradientOpacity>>;
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
    case ShadeBy::asFrame:  // of the levels' kernels alone
    case ShadeBy::nothing:
      break;
  }
  return ChooseOpacity<Store, ShadeBy::nothing>(key);
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
