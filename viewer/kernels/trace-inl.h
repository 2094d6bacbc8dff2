// Composite kernels for plain steps over one store. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_TRACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_TRACE_INL_H_
#undef VOLUMEN_KERNELS_TRACE_INL_H_
#else
#define VOLUMEN_KERNELS_TRACE_INL_H_
#endif

#include "viewer/kernels/batch-inl.h"
#include "viewer/kernels/sparse-inl.h"
#include "viewer/kernels/step_groups-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// True for the stores that hold volumes without loss.
template <class Store>
constexpr bool kIsWhole = std::is_same_v<Store, Int16Store> || std::is_same_v<Store, Float32Store>;

template <class Store, bool kIsLit, bool kGradientOpacity>
TraceKernel ChooseSamples(Sampling sampling) {
  if constexpr (kIsWhole<Store>)
    if (sampling == Sampling::nested) return TraceRays<BatchTracer<Store, kIsLit, kGradientOpacity, true>>;
  if constexpr (!std::is_void_v<Store>) {
    const bool few = sampling == Sampling::visibleCells;
    if constexpr (Store::kWhereFew == WhereFew::batches) {
      if (few) return TraceRays<BatchTracer<Store, kIsLit, kGradientOpacity>>;
    } else if constexpr (kIsLit || kGradientOpacity) {
      if (few) return TraceRays<SparseTracer<Store, kIsLit, kGradientOpacity>>;
    }
  }
  return TraceRays<DenseTracer<Store, kIsLit, kGradientOpacity>>;
}

template <class Store>
TraceKernel ChoosePlain(KernelKey key) {
  if (key.gradientOpacity)
    return key.lit ? ChooseSamples<Store, true, true>(key.sampling)
                   : ChooseSamples<Store, false, true>(key.sampling);
  return key.lit ? ChooseSamples<Store, true, false>(key.sampling)
                 : ChooseSamples<Store, false, false>(key.sampling);
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
