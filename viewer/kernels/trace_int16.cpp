// Composite kernels for volumes of 16-bit samples.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/kernels/trace_int16.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/kernels/trace-inl.h"
#include "viewer/kernels/trace.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {
TraceKernel ChooseTraceInt16(KernelKey key) { return ChoosePlain<Int16Store>(key); }
}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {
HWY_EXPORT(ChooseTraceInt16);
TraceKernel chooseTraceInt16(KernelKey key) { return HWY_DYNAMIC_DISPATCH(ChooseTraceInt16)(key); }
}  // namespace volumen
#endif  // HWY_ONCE
