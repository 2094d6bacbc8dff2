// Composite kernels for volumes of floats.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/kernels/trace_float32.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/kernels/trace-inl.h"
#include "viewer/kernels/trace.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {
TraceKernel ChooseTraceFloat32(KernelKey key) { return ChoosePlain<Float32Store>(key); }
}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {
HWY_EXPORT(ChooseTraceFloat32);
TraceKernel chooseTraceFloat32(KernelKey key) { return HWY_DYNAMIC_DISPATCH(ChooseTraceFloat32)(key); }
}  // namespace volumen
#endif  // HWY_ONCE
