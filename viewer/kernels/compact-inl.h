// Compression and expansion of vector lanes. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_COMPACT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_COMPACT_INL_H_
#undef VOLUMEN_KERNELS_COMPACT_INL_H_
#else
#define VOLUMEN_KERNELS_COMPACT_INL_H_
#endif

#include <cstdint>

#include "viewer/kernels/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

constexpr int kLanes = int(hn::MaxLanes(DF()));

/// Returns a mask as bits: lane n in bit n.
HWY_INLINE std::uint32_t BitsOf(MF m) {
  std::uint64_t bits = 0;
  hn::StoreMaskBits(DF(), m, reinterpret_cast<std::uint8_t*>(&bits));
  return std::uint32_t(bits) & ((1u << kLanes) - 1);
}
HWY_INLINE MF MaskOf(std::uint64_t bits) {
  return hn::LoadMaskBits(DF(), reinterpret_cast<const std::uint8_t*>(&bits));
}

#if HWY_TARGET == HWY_AVX2
/// For each mask, its chosen lanes first, one byte each. GCC 12 copies Highway's table to the stack at every
/// use.
struct LaneOrder {
  std::uint8_t lanes[256][8];

  constexpr LaneOrder() : lanes() {
    for (int mask = 0; mask < 256; ++mask) {
      int at = 0;
      for (int wanted = 1; wanted >= 0; --wanted)
        for (int lane = 0; lane < 8; ++lane)
          if ((mask >> lane & 1) == wanted) lanes[mask][at++] = std::uint8_t(lane);
    }
  }
};
alignas(64) inline constexpr LaneOrder kLaneOrder;

HWY_INLINE VF Compressed(VF v, MF which) {
  const std::uint8_t* order = kLaneOrder.lanes[BitsOf(which)];
  const VI lanes = hn::PromoteTo(DI(), hn::LoadU(hn::Rebind<std::uint8_t, DI>(), order));
  return hn::TableLookupLanes(v, hn::IndicesFromVec(DF(), lanes));
}
#else
HWY_INLINE VF Compressed(VF v, MF which) { return hn::Compress(v, which); }
#endif

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE VF Expanded(VF v, MF which) { return hn::IfThenElseZero(which, v); }
#elif HWY_MAX_BYTES == 64
HWY_INLINE VF Expanded(VF v, MF which) { return VF{_mm512_maskz_expand_ps(which.raw, v.raw)}; }
#else
/// For each mask and lane, the number of chosen lanes below it.
struct LanesBelow {
  std::uint8_t lanes[1 << kLanes][kLanes];

  constexpr LanesBelow() : lanes() {
    for (int mask = 0; mask < 1 << kLanes; ++mask) {
      int below = 0;
      for (int lane = 0; lane < kLanes; below += mask >> lane++ & 1)
        lanes[mask][lane] = std::uint8_t(below % kLanes);
    }
  }
};
alignas(64) inline constexpr LanesBelow kLanesBelow;

HWY_INLINE VF Expanded(VF v, MF which) {
  const std::uint8_t* below = kLanesBelow.lanes[BitsOf(which)];
  const VI lanes = hn::PromoteTo(DI(), hn::LoadU(hn::Rebind<std::uint8_t, DI>(), below));
  return hn::IfThenElseZero(which, hn::TableLookupLanes(v, hn::IndicesFromVec(DF(), lanes)));
}
#endif

/// Distributes the lowest bits of `bits` to the set bits of `where`, lowest first.
HWY_INLINE std::uint32_t Deposited(std::uint32_t bits, std::uint32_t where) {
#if HWY_ARCH_X86_64 && HWY_MAX_BYTES >= 32
  return _pdep_u32(bits, where);
#else
  std::uint32_t all = 0;
  for (; where; where &= where - 1, bits >>= 1)
    if (bits & 1) all |= where & (~where + 1);
  return all;
#endif
}

/// Appends the chosen lanes to an array that has room for a whole vector behind `at`. They are compressed in
/// a register and stored whole. Compressing into memory is microcoded on some CPUs and many times slower.
HWY_INLINE void Append(VF v, MF which, float* at) { hn::StoreU(Compressed(v, which), DF(), at); }
HWY_INLINE void Append(VI v, MF which, std::int32_t* at) {
  hn::StoreU(hn::BitCast(DI(), Compressed(hn::BitCast(DF(), v), which)), DI(), at);
}
/// Appends the chosen positions to arrays (PlaceOf), starting at index `at`.
template <class Array>
HWY_INLINE void AppendPlaces(const V3& v, MF which, Array& s, int at) {
  Append(v.x, which, s.x + at);
  Append(v.y, which, s.y + at);
  Append(v.z, which, s.z + at);
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
