// Composite kernels for volumes of bytes.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/kernels/trace_bytes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/kernels/bytes-inl.h"
#include "viewer/kernels/trace-inl.h"
#include "viewer/kernels/trace.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {
TraceKernel ChooseTraceBytes(KernelKey key) {
  return key.store == Store::byte1 ? ChooseSamples<Byte1Store, false, false>(key.sampling)
                                   : ChoosePlain<Byte4Store>(key);
}
}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {
HWY_EXPORT(ChooseTraceBytes);
TraceKernel chooseTraceBytes(KernelKey key) { return HWY_DYNAMIC_DISPATCH(ChooseTraceBytes)(key); }
}  // namespace volumen
#endif  // HWY_ONCE
