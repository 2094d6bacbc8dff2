// Passing over blocks that hold nothing visible, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_SKIP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_SKIP_INL_H_
#undef VOLUMEN_RENDER_KERNELS_SKIP_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_SKIP_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstring>

#include "viewer/render/kernels/packet-inl.h"
#include "viewer/render/skip_map.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// The rays of `alive` whose place, clamped to the grid, lies in a visible block.
HWY_INLINE MF InVisibleBlock(const SkipMap& skip, MF alive, const V3& clamped) {
  const DF df;
  const DI di;
  static_assert(SkipMap::edge == 4);
  const auto block = [&](VF x) { return hn::ShiftRight<2>(hn::ConvertTo(di, x)); };
  const VI row = hn::Add(hn::Mul(block(clamped.z), SetI(skip.count.y)), block(clamped.y));
  const VI index = hn::Add(hn::Mul(row, SetI(skip.count.x)), block(clamped.x));
  const auto* base = reinterpret_cast<const std::int32_t*>(skip.visible.data());
  const VI seen = hn::And(hn::GatherOffset(di, base, index), SetI(255));
  return hn::AndNot(hn::RebindMask(df, hn::Eq(seen, hn::Zero(di))), alive);
}

/// Says at which steps a packet must be looked at: one look into the map for all of its rays, at the lower
/// corner of the box around them (SkipMap). Packets that spread wider than the map reaches are looked at
/// everywhere.
class Skipper {
 public:
  Skipper(const TraceFrame& f, const Packet& p) : map_(f.skip) {
    if (!map_) return;
    const DF df;
    const MF real = HasStep(p, 0);
    if (hn::AllFalse(df, real)) return;
    const VF start[3] = {p.start.x, p.start.y, p.start.z}, move[3] = {p.move.x, p.move.y, p.move.z};
    for (int a = 0; a < 3; ++a) {
      // Between the ends of the packet its rays are nowhere farther apart than at one of them.
      const VF last = hn::Add(start[a], hn::Mul(move[a], Set(float(p.longest))));
      const Range begin = RangeOf(start[a], real), end = RangeOf(last, real);
      const float half = 0.5f * std::max(begin.high - begin.low, end.high - end.low);
      const float middle = 0.5f * (begin.low + begin.high);
      move_[a] = (0.5f * (end.low + end.high) - middle) / float(p.longest);
      // Intervals reach half a step to either side, and the last sample of a ray stands up to half a step
      // before its place in the row. A hundredth of a voxel is far more than positions are rounded by.
      const float back = 0.5f * std::abs(move_[a]) + 0.01f;
      size_[a] = 2 * half + 2 * back;
      if (size_[a] > float(map_->reach * SkipMap::edge)) map_ = nullptr;
      if (!map_) return;
      start_[a] = middle - half - back;
      last_[a] = float(f.size[a] - 1);
    }
  }

  /// One bit a step, from `step` on, as many as a vector has lanes.
  HWY_INLINE std::uint64_t LookFrom(int step) const {
    const DF df;
    const DI di;
    if (!map_) return (std::uint64_t(1) << hn::Lanes(df)) - 1;
    static_assert(SkipMap::edge == 4);
    const VF middle = hn::Add(hn::Add(hn::Iota(df, 0), Set(float(step))), Set(0.5f));
    const auto block = [&](int a, VF x) {
      return hn::ShiftRight<2>(hn::ConvertTo(di, hn::Min(hn::Max(x, hn::Zero(df)), Set(last_[a]))));
    };
    MF wide = hn::FirstN(df, 0);
    VI index[3];
    for (int a = 0; a < 3; ++a) {
      const VF x = hn::Add(Set(start_[a]), hn::Mul(middle, Set(move_[a])));
      index[a] = block(a, x);
      const VI across = hn::Sub(block(a, hn::Add(x, Set(size_[a]))), index[a]);
      wide = hn::Or(wide, hn::RebindMask(df, hn::Gt(across, SetI(map_->reach - 1))));
    }
    const VI row = hn::Add(hn::Mul(index[2], SetI(map_->count.y)), index[1]);
    const VI inMap = hn::Add(hn::Mul(row, SetI(map_->count.x)), index[0]);
    const VI mapOf =
        hn::IfThenElseZero(hn::RebindMask(di, wide), SetI(map_->count.x * map_->count.y * map_->count.z));
    const auto* base = reinterpret_cast<const std::int32_t*>(map_->near.data());
    const VI seen = hn::And(hn::GatherOffset(di, base, hn::Add(inMap, mapOf)), SetI(255));
    alignas(8) std::uint8_t bits[8] = {};
    hn::StoreMaskBits(di, hn::Ne(seen, hn::Zero(di)), bits);
    std::uint64_t mask;
    std::memcpy(&mask, bits, 8);
    return mask & ((std::uint64_t(1) << hn::Lanes(df)) - 1);
  }

 private:
  struct Range {
    float low, high;
  };
  static HWY_INLINE Range RangeOf(VF v, MF of) {
    const DF df;
    return {hn::GetLane(hn::MinOfLanes(df, hn::IfThenElse(of, v, Set(1e30f)))),
            hn::GetLane(hn::MaxOfLanes(df, hn::IfThenElse(of, v, Set(-1e30f))))};
  }

  const SkipMap* map_;
  float start_[3] = {}, size_[3] = {}, move_[3] = {}, last_[3] = {};
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
