// Composite kernels for integration levels: rays go from cell to cell.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/kernels/trace_levels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/kernels/levels-inl.h"
#include "viewer/kernels/step_groups-inl.h"
#include "viewer/kernels/trace.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

template <class Store>
TraceKernel ChooseLevel(KernelKey key) {
  if (key.gradientOpacity)
    return key.lit ? TraceRays<LevelTracer<Store, true, true>> : TraceRays<LevelTracer<Store, false, true>>;
  return key.lit ? TraceRays<LevelTracer<Store, true, false>> : TraceRays<LevelTracer<Store, false, false>>;
}

TraceKernel ChooseTraceLevels(KernelKey key) {
  return key.store == Store::int16 ? ChooseLevel<Int16Store>(key) : ChooseLevel<Float32Store>(key);
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {
HWY_EXPORT(ChooseTraceLevels);
TraceKernel chooseTraceLevels(KernelKey key) { return HWY_DYNAMIC_DISPATCH(ChooseTraceLevels)(key); }
}  // namespace volumen
#endif  // HWY_ONCE
