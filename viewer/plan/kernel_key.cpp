#include "viewer/plan/kernel_key.h"

#include "viewer/plan/plan.h"

namespace volumen {

namespace {

Store storeOf(const Plan& plan) {
  if (plan.resampler != Resampler::cpu) return Store::plane;
  if (plan.bits == 8) return plan.gradients ? Store::byte4 : Store::byte1;
  return plan.bits == 16 ? Store::int16 : Store::float32;
}

Sampling samplingOf(const Plan& plan) {
  if (plan.cellByCell) return Sampling::passages;
  if (plan.redoneAbove > 0) return Sampling::nested;
  return plan.skipCells ? Sampling::visibleCells : Sampling::dense;
}

}  // namespace

KernelKey kernelKey(const Plan& plan) {
  return {storeOf(plan), samplingOf(plan), plan.lit, plan.gradientOpacity};
}

}  // namespace volumen
