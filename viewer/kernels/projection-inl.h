// MIP, MinIP and average along the rays of one packet. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_PROJECTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_PROJECTION_INL_H_
#undef VOLUMEN_KERNELS_PROJECTION_INL_H_
#else
#define VOLUMEN_KERNELS_PROJECTION_INL_H_
#endif

#include <limits>

#include "viewer/kernels/faces-inl.h"
#include "viewer/kernels/passage-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// The extreme a projection searches for: the maximum for mip, the minimum for minip.
template <Mode kMode>
struct Extreme {
  static constexpr float kNone = (kMode == Mode::mip ? -1 : 1) * std::numeric_limits<float>::max();
  static HWY_INLINE VF Of(VF a, VF b) { return kMode == Mode::mip ? hn::Max(a, b) : hn::Min(a, b); }
  static HWY_INLINE VF Nearer(VF a, VF b) { return kMode == Mode::mip ? hn::Min(a, b) : hn::Max(a, b); }
  static HWY_INLINE MF Exceeds(VF a, VF b) { return kMode == Mode::mip ? hn::Gt(a, b) : hn::Lt(a, b); }

  static HWY_INLINE VF Of(const Corners& v) { return kMode == Mode::mip ? v.Highest() : v.Lowest(); }

  /// Returns the more extreme of a - b and a + b.
  static HWY_INLINE VF Widest(VF a, VF b) {
    return kMode == Mode::mip ? hn::Add(a, hn::Abs(b)) : hn::Sub(a, hn::Abs(b));
  }

  /// Returns a bound on the cubic over its interval from its Bernstein coefficients. Only rounding exceeds
  /// it.
  static HWY_INLINE VF BoundOf(const Cubic& c) {
    const VF third = Set(1.0f / 3);
    const VF inner = Widest(hn::Sub(c.c0, hn::Mul(c.c2, third)), hn::Sub(hn::Mul(c.c1, third), c.c3));
    return Of(inner, Widest(hn::Add(c.c0, c.c2), hn::Add(c.c1, c.c3)));
  }

  /// Returns the extreme over the interval: at an end, or where the slope c1 + 2 c2 s + 3 c3 s^2 vanishes.
  static HWY_INLINE VF Of(const Cubic& c) {
    const DF df;
    const VF ends = Widest(hn::Add(c.c0, c.c2), hn::Add(c.c1, c.c3));
    const VF a = hn::Mul(Set(3), c.c3), square = hn::Sub(hn::Mul(c.c2, c.c2), hn::Mul(a, c.c1));
    const MF turns = hn::Gt(square, hn::Zero(df));
    if (hn::AllFalse(df, turns)) return ends;
    // No digits cancel in this sum. A root outside is replaced by the nearer end, which does no harm.
    const VF root = hn::Sqrt(hn::Max(square, hn::Zero(df)));
    const VF q = hn::Neg(hn::Add(c.c2, hn::CopySign(root, c.c2)));
    const auto at = [&](VF over, VF under) {
      const VF divisor = hn::IfThenElse(hn::Eq(under, hn::Zero(df)), Set(1), under);
      return c.At(hn::Min(hn::Max(hn::Div(over, divisor), Set(-1)), Set(1)));
    };
    return hn::IfThenElse(turns, Of(ends, Of(at(q, a), at(c.c1, q))), ends);
  }
};

/// A sum of many terms with Kahan's compensation for rounding.
struct LongSum {
  VF sum = hn::Zero(DF()), lost = hn::Zero(DF());
  HWY_INLINE LongSum() {}  // An implicit constructor is compiled for no target.

  HWY_INLINE void Add(MF where, VF value) {
    const VF term = hn::Sub(value, lost), next = hn::Add(sum, term);
    lost = hn::IfThenElse(where, hn::Sub(hn::Sub(next, sum), term), lost);
    sum = hn::IfThenElse(where, next, sum);
  }
};

/// Projects the samples of plain steps.
template <class Store, Mode kMode>
class SampleProjection {
 public:
  SampleProjection(const RayInputs& f, const Grid& grid, const RayRow& rays, const PlaneBuffer& plane,
                   int first)
      : grid_(grid), plane_(plane), packet_(LoadPacket(f, rays, first)), first_(first) {
    packet_.ahead = Set(0);  // Rays start at once: no sample waits for that of another ray.
  }

  /// Takes the samples at one step. Returns their number.
  HWY_INLINE std::int64_t Take(int step) {
    const VF n = SampleAt(packet_, step);
    const MF has = HasSample(packet_, n), last = IsLast(packet_, n);
    VF density;
    if constexpr (std::is_void_v<Store>)
      density = hn::LoadU(DF(), plane_.density + std::size_t(step) * plane_.stride + first_);
    else
      density = Store::Density(grid_, grid_.CellAt(grid_.Clamped(Position(packet_, n, last))));
    if constexpr (kMode == Mode::average)
      sum_.Add(has, hn::Mul(density, hn::IfThenElse(last, packet_.lastUnitDistances, packet_.unitDistances)));
    else
      value_ = hn::IfThenElse(has, Extreme<kMode>::Of(value_, density), value_);
    return std::int64_t(hn::CountTrue(DF(), has));
  }

  /// Returns the extreme reached by all rays of the packet: the least of their maxima or the largest of their
  /// minima.
  HWY_INLINE float ReachedByAll() const {
    const DF df;
    const VF others = Set(-Extreme<kMode>::kNone);
    const VF reached = hn::IfThenElse(hn::Gt(packet_.steps, hn::Zero(df)), value_, others);
    return hn::GetLane(kMode == Mode::mip ? hn::MinOfLanes(df, reached) : hn::MaxOfLanes(df, reached));
  }

  HWY_INLINE VF Result() const {
    if constexpr (kMode != Mode::average) return value_;
    const Packet& p = packet_;
    const VF length = hn::Add(hn::Mul(hn::Sub(p.steps, Set(1)), p.unitDistances), p.lastUnitDistances);
    return hn::Div(sum_.sum, hn::Max(length, Set(1e-30f)));
  }

  const Packet& Rays() const { return packet_; }

 private:
  const Grid& grid_;
  const PlaneBuffer& plane_;
  Packet packet_;
  const int first_;
  VF value_ = Set(Extreme<kMode>::kNone);
  LongSum sum_;
};

/// Projects from cell to cell. Along each passage the density is a cubic with known extremes and mean.
template <class Store, Mode kMode>
class CellProjection {
 public:
  CellProjection(const RayInputs& f, const Grid& grid, const RayRow& rays, int first)
      : grid_(grid), packet_(LoadPacket(f, rays, first)) {}

  /// Takes the passages of each ray from `at` up to `to`, in steps from the ray's start, while more than
  /// `least` rays have not arrived. `at` must be the ray's start or a face of a cell, and is set to where
  /// each ray is then. Returns the number of passages.
  HWY_NOINLINE std::int64_t Take(VF& at, VF to, int least) {
    const VF end = hn::Min(to, EndOf(packet_));
    std::int64_t taken = 0;
    FaceWalk walk(packet_, at, 1);
    for (;;) {
      const MF open = hn::Lt(walk.at, end);
      const int count = int(hn::CountTrue(DF(), open));
      if (count <= least) break;
      taken += count;
      const VF upTo = hn::Min(walk.NextFace(), end);
      TakePassage(open, walk, hn::Sub(upTo, walk.at));
      walk.GoTo(upTo);
    }
    at = walk.at;
    return taken;
  }

  HWY_INLINE VF Result() const {
    if constexpr (kMode != Mode::average) return value_;
    return hn::Div(sum_.sum, hn::Max(EndOf(packet_), Set(1e-30f)));
  }

  const Packet& Rays() const { return packet_; }
  VF Value() const { return value_; }

 private:
  HWY_INLINE void TakePassage(MF open, const FaceWalk& walk, VF length) {
    const VF half = hn::Mul(length, Set(0.5f));
    const Passage passage =
        PassageIn(grid_, {walk.x.Lower(), walk.y.Lower(), walk.z.Lower()},
                  Add(packet_.start, Scale(packet_.move, hn::Add(walk.at, half))), Scale(packet_.move, half));
    const Corners corners = Store::CornersOf(grid_, passage.cell);
    if constexpr (kMode == Mode::average)
      sum_.Add(open, hn::Mul(length, Mean(InterpolateAlong(corners, passage))));
    else
      TakeExtreme(open, passage, corners);
  }

  static HWY_INLINE VF Mean(const Cubic& c) { return hn::Add(c.c0, hn::Mul(c.c2, Set(1.0f / 3))); }

  HWY_INLINE void TakeExtreme(MF open, const Passage& passage, const Corners& corners) {
    using E = Extreme<kMode>;
    const VF most = E::Of(corners);
    if (hn::AllFalse(DF(), hn::And(open, E::Exceeds(most, value_)))) return;
    const Cubic along = InterpolateAlong(corners, passage);
    const VF bound = E::Nearer(most, E::BoundOf(along));
    const MF may = hn::And(open, E::Exceeds(bound, value_));
    if (hn::AllFalse(DF(), may)) return;
    // Only rounding exceeds the bound. It depends on earlier passages whether the bound is tested, so values
    // are limited to it: the result must not depend on them.
    value_ = hn::IfThenElse(may, E::Of(value_, E::Nearer(E::Of(along), bound)), value_);
  }

  const Grid& grid_;
  const Packet packet_;
  VF value_ = Set(Extreme<kMode>::kNone);
  LongSum sum_;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
