#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/render/kernels/project.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

#include "viewer/render/kernels/bytes-inl.h"
#include "viewer/render/kernels/packet-inl.h"
#include "viewer/render/kernels/sample-inl.h"
#include "viewer/render/kernels/trace.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// mip, minip and average: no table, no shading.
template <class Store, Mode kMode>
void ProjectRays(const TraceFrame& f, const RayRow& rays, const PlaneBuffer& plane, float* result) {
  const DF df;
  const Grid grid(f);
  for (int first = 0; first < rays.count; first += int(hn::Lanes(df))) {
    const Packet p = LoadPacket(f, rays, first);
    const float none = kMode == Mode::mip     ? -std::numeric_limits<float>::max()
                       : kMode == Mode::minip ? std::numeric_limits<float>::max()
                                              : 0;
    VF value = Set(none);
    VF lost = Set(0);  // of the sum, in rounding: Kahan's compensation, as samples are many
    for (int step = 0; step < p.longest; ++step) {
      const VF n = Set(float(step));
      const MF last = IsLast(p, n);
      VF density;
      if constexpr (std::is_void_v<Store>)
        density = hn::LoadU(df, plane.density + std::size_t(step) * plane.stride + first);
      else
        density = Store::Density(grid, grid.CellAt(grid.Clamped(Position(p, n, last))));
      VF next;
      if constexpr (kMode == Mode::mip)
        next = hn::Max(value, density);
      else if constexpr (kMode == Mode::minip)
        next = hn::Min(value, density);
      else {
        const VF term = hn::Sub(hn::Mul(density, hn::IfThenElse(last, p.lastUnits, p.units)), lost);
        next = hn::Add(value, term);
        lost = hn::Sub(hn::Sub(next, value), term);
      }
      value = hn::IfThenElse(HasSample(p, n), next, value);
    }
    if constexpr (kMode == Mode::average) {
      const VF length = hn::Add(hn::Mul(hn::Sub(p.steps, Set(1)), p.units), p.lastUnits);
      value = hn::Div(value, hn::Max(length, Set(1e-30f)));
    }
    hn::StoreU(value, df, result + first);
  }
}

template <class Store>
ProjectKernel ChooseMode(Mode mode) {
  return mode == Mode::mip     ? ProjectRays<Store, Mode::mip>
         : mode == Mode::minip ? ProjectRays<Store, Mode::minip>
                               : ProjectRays<Store, Mode::average>;
}

ProjectKernel ChooseProject(Store store, Mode mode) {
  return store == Store::int16     ? ChooseMode<Int16Store>(mode)
         : store == Store::float32 ? ChooseMode<Float32Store>(mode)
         : store == Store::byte1   ? ChooseMode<Byte1Store>(mode)
                                   : ChooseMode<void>(mode);
}

const char* TargetName() { return hwy::TargetName(HWY_TARGET); }

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(ChooseProject);
HWY_EXPORT(TargetName);

ProjectKernel chooseProjectKernel(Store store, Mode mode) {
  return HWY_DYNAMIC_DISPATCH(ChooseProject)(store, mode);
}
const char* kernelTarget() { return HWY_DYNAMIC_DISPATCH(TargetName)(); }

TraceKernel chooseTraceKernel(TraceKey key) {
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
