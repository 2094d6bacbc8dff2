// Lighting looked up without interpolation, as in the paper (2.2). Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_TABLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_TABLE_INL_H_
#undef VOLUMEN_KERNELS_TABLE_INL_H_
#else
#define VOLUMEN_KERNELS_TABLE_INL_H_
#endif

#include "viewer/kernels/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Returns the shaded colour of samples from the 4-index table, without normal or curve.
HWY_INLINE V3 ShadeByTable(const ShadeTable& t, const V3& stored, VF density) {
  const DF df;
  const DI di;
  const VF half = Set(0.5f), zero = Set(float(ShadeTable::zero)), none = hn::Zero(df);
  const auto component = [&](VF g) {
    const VF place = hn::Add(hn::Mul(g, Set(t.perGradient)), hn::Add(zero, half));
    return Truncated(hn::Min(hn::Max(place, none), hn::Add(zero, zero)));
  };
  const VF place = hn::Add(hn::Mul(hn::Sub(density, Set(t.densityLow)), Set(t.perDensity)), half);
  const VI d = Truncated(hn::Min(hn::Max(place, none), Set(float(ShadeTable::side - 1))));
  constexpr int bits = ShadeTable::indexBits;
  VI at = hn::Add(hn::ShiftLeft<bits>(component(stored.z)), component(stored.y));
  at = hn::Add(hn::ShiftLeft<bits>(at), component(stored.x));
  at = hn::Add(hn::ShiftLeft<bits>(at), d);
  const VI bgr = hn::GatherIndex(di, t.bgr.data(), at);
  const auto part = [&](VI byte) {
    return hn::Mul(hn::ConvertTo(df, hn::And(byte, SetI(255))), Set(1.0f / 255));
  };
  return {part(bgr), part(hn::ShiftRight<8>(bgr)), part(hn::ShiftRight<16>(bgr))};
}

/// Returns D' and S' of the patch of the reflectance map that the normal points at.
HWY_INLINE DS ShadeMapNearest(const ReflectanceMap& map, const V3& n) {
  const DF df;
  const CubePlace place = OnCube(n);
  const VF half = Set(0.5f * float(map.n));
  const auto patch = [&](VF c) {
    const VI p = Truncated(hn::Max(hn::Mul(hn::Add(c, Set(1)), half), hn::Zero(df)));
    return hn::Min(p, SetI(map.n - 1));
  };
  const VI node = hn::Add(hn::Mul(hn::Add(hn::Mul(place.face, SetI(map.n)), patch(place.v)), SetI(map.n)),
                          patch(place.u));
  const VI at = FirstFloat(map, node);
  const auto read = [&](int c) { return hn::GatherIndex(df, map.nodes.data() + c, at); };
  if (!map.coloured) return InGrey(read(0), read(1));
  return {{read(0), read(2), read(4)}, {read(1), read(3), read(5)}};
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
