// Composite kernels for planes that another resampler has filled.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/kernels/trace_plane.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/kernels/trace-inl.h"
#include "viewer/kernels/trace.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {
TraceKernel ChooseTracePlane(KernelKey key) { return ChoosePlain<void>(key); }
}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {
HWY_EXPORT(ChooseTracePlane);
TraceKernel chooseTracePlane(KernelKey key) { return HWY_DYNAMIC_DISPATCH(ChooseTracePlane)(key); }
}  // namespace volumen
#endif  // HWY_ONCE
