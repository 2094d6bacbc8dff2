#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/kernels/trace.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/kernels/trace.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {
const char* TargetName() { return hwy::TargetName(HWY_TARGET); }
}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(TargetName);
const char* kernelTarget() { return HWY_DYNAMIC_DISPATCH(TargetName)(); }

TraceKernel chooseTraceKernel(KernelKey key) {
  if (key.sampling == Sampling::passages) return chooseTraceLevels(key);
  switch (key.store) {
    case Store::int16:
      return chooseTraceInt16(key);
    case Store::float32:
      return chooseTraceFloat32(key);
    case Store::byte1:
    case Store::byte4:
      return chooseTraceBytes(key);
    case Store::plane:
      break;
  }
  return chooseTracePlane(key);
}

}  // namespace volumen
#endif  // HWY_ONCE
