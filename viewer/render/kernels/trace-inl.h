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

template <class Store, bool kIsLit, bool kGradientOpacity>
TraceKernel ChooseSamples(bool cells) {
  if constexpr (!std::is_void_v<Store>) {
    using Few = std::conditional_t<Store::kWhereFew == WhereFew::batches,
                                   BatchTracer<Store, kIsLit, kGradientOpacity>,
                                   SparseTracer<Store, kIsLit, kGradientOpacity>>;
    if (cells) return TraceRays<Few>;
  }
  return TraceRays<DenseTracer<Store, kIsLit, kGradientOpacity>>;
}

template <class Store>
TraceKernel ChoosePlain(TraceKey key) {
  if (key.gradientOpacity)
    return key.lit ? ChooseSamples<Store, true, true>(key.cells)
                   : ChooseSamples<Store, false, true>(key.cells);
  return key.lit ? ChooseSamples<Store, true, false>(key.cells)
                 : ChooseSamples<Store, false, false>(key.cells);
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
