// Integrates rays cell by cell with local error control. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_INTEGRATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_INTEGRATE_INL_H_
#undef VOLUMEN_KERNELS_INTEGRATE_INL_H_
#else
#define VOLUMEN_KERNELS_INTEGRATE_INL_H_
#endif

#include <algorithm>

#include "viewer/kernels/compact-inl.h"
#include "viewer/kernels/part-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Result of a ray's passage through a cell, for light of strength 1 in front of it.
struct PassageSum {
  V3 colour;  ///< Premultiplied.
  VF opacity, error;
};

/// Passages, one per lane, and the light that reaches them.
struct LoadedPassages {
  RayInCell r;
  VF through;
};

/// Integrates passages front to back, one per lane. A passage is cut exactly where its density turns and
/// where it crosses a point of the curve. A piece between two cuts therefore holds no kink of the curve.
/// Pieces are subdivided adaptively into parts (PartRule). A part is cut further while its error, times the
/// light that reaches it, exceeds its share of the budget (ErrorBudget).
template <class Material>
class PassageIntegrator {
 public:
  PassageIntegrator(const RayInputs& f, const Material& matter) : f_(f), rule_(matter) {}

  /// Integrates `count` passages. A lane that has finished one takes the next, so that passages of one part
  /// need not wait for passages of many.
  /// `load(n, lanes)` returns the passages from the n-th on, one in each of `lanes` (LoadedPassages).
  /// `take(ray, lanes, through, sum)` receives the passages finished in `lanes`. `parts` is increased by the
  /// number of parts.
  template <class Load, class Take>
  HWY_INLINE void Integrate(int count, const Load& load, const Take& take, std::int64_t& parts) const {
    const DF df;
    const VF one = Set(1);
    PassageLanes lanes;
    MF active = hn::FirstN(df, 0);
    for (int next = 0;;) {
      MF begins = hn::FirstN(df, 0);
      if (next < count && int(hn::CountTrue(df, active)) <= kLanes - kRefill) {
        begins = Refill(count, load, hn::Not(active), next, lanes);
        active = hn::Or(active, begins);
      }
      if (hn::AllFalse(df, active)) return;
      const MF turns = hn::Or(begins, hn::And(active, hn::Ge(lanes.s, lanes.piece.end)));
      if (!hn::AllFalse(df, turns)) NextPiece(turns, lanes);
      const VF s = lanes.s, end = hn::Add(s, lanes.length);
      const MF nearEnd = hn::Ge(hn::Add(end, hn::Mul(lanes.length, Set(0.1f))), lanes.piece.end);
      const VF upTo = hn::IfThenElse(nearEnd, lanes.piece.end, end);
      const VF reach = hn::Mul(lanes.through, lanes.left);
      const Fragment back = rule_.FragmentAt(lanes.r, lanes.piece.segment, upTo);
      const PartSum part = rule_.Integrate(lanes.r, {s, upTo, lanes.piece.segment}, lanes.front, back, reach);
      const VF off = hn::Mul(reach, part.error), share = rule_.ShareOf(reach, part.opacity);
      const MF tooFar = hn::And(hn::Gt(off, share), hn::Gt(hn::Sub(upTo, s), Set(kShortest)));
      const MF taken = hn::AndNot(tooFar, active);
      parts += std::int64_t(hn::CountTrue(df, taken));
      const VF seen = hn::IfThenElseZero(taken, lanes.left);
      lanes.sum.colour = Add(lanes.sum.colour, Scale(part.colour, seen));
      lanes.sum.error = hn::Add(lanes.sum.error, hn::Mul(seen, part.error));
      lanes.left = hn::Sub(lanes.left, hn::Mul(seen, part.opacity));
      lanes.length = hn::IfThenElse(taken, hn::Add(lanes.length, lanes.length),
                                    NextLength(hn::Sub(upTo, s), off, share));
      lanes.s = hn::IfThenElse(taken, upTo, s);
      lanes.front = Chosen(taken, back, lanes.front);
      const MF goesOn = hn::And(hn::Or(tooFar, hn::Lt(lanes.s, one)),
                                hn::Gt(hn::Mul(lanes.through, lanes.left), Set(f_.stopTransmittance)));
      const MF done = hn::AndNot(goesOn, active);
      if (hn::AllFalse(df, done)) continue;
      lanes.sum.opacity = hn::Sub(one, lanes.left);
      take(lanes.r.ray, done, lanes.through, lanes.sum);
      active = hn::And(active, goesOn);
    }
  }

 private:
  static constexpr float kShortest = 1.0f / 2048;   ///< Parts are not cut below this length.
  static constexpr int kRefill = (kLanes + 3) / 4;  ///< Number of idle lanes that triggers a refill.

  /// The stretch between two cuts of a passage.
  struct Piece {
    VF turn1 = Set(2), turn2 = Set(2);  ///< Extremes of the density along the passage; 2: none.
    VI index = SetI(0);                 ///< Segment of the curve.
    CurveSegment segment{};
    VF end = Set(1);
    VI step = SetI(0);     ///< Index of the next piece's segment minus this one's: -1, 0 or 1.
    HWY_INLINE Piece() {}  // An implicit constructor is compiled for no target.
  };

  /// A passage in each lane, and the progress along it.
  struct PassageLanes {
    RayInCell r{};
    VF through = hn::Zero(DF());     ///< Light that reaches the passage.
    VF left = hn::Zero(DF());        ///< Fraction of that light that reaches s.
    VF s = Set(1), length = Set(2);  ///< Current position; length of the part to try next.
    Piece piece;
    Fragment front{};  ///< Fragment at s.
    PassageSum sum{Zero3(), hn::Zero(DF()), hn::Zero(DF())};
    HWY_INLINE PassageLanes() {}
  };

  /// Gives the `idle` lanes the passages from `next` on, as far as there are any. Returns the lanes that
  /// begin one.
  template <class Load>
  HWY_INLINE MF Refill(int count, const Load& load, MF idle, int& next, PassageLanes& lanes) const {
    const DF df;
    const VF number = Expanded(hn::Iota(df, float(next)), idle);
    const MF begins = hn::And(idle, hn::Lt(number, Set(float(count))));
    const LoadedPassages loaded = load(next, idle);
    next = std::min(count, next + int(hn::CountTrue(df, idle)));
    lanes.r = Chosen(begins, loaded.r, lanes.r);
    lanes.through = hn::IfThenElse(begins, loaded.through, lanes.through);
    lanes.left = hn::IfThenElse(begins, Set(1), lanes.left);
    lanes.s = hn::IfThenElse(begins, Set(-1), lanes.s);
    PassageSum& sum = lanes.sum;
    for (VF* value : {&sum.colour.x, &sum.colour.y, &sum.colour.z, &sum.error})
      *value = hn::IfThenElseZero(hn::Not(begins), *value);
    SetTurns(lanes.r.density.along, lanes.piece);
    const auto first = hn::RebindMask(DI(), begins);
    lanes.piece.index = hn::IfThenElse(first, FirstSegment(lanes.r.density), lanes.piece.index);
    lanes.piece.step = hn::IfThenElseZero(hn::Not(first), lanes.piece.step);
    return begins;
  }

  /// Returns the segment of the curve in which a passage begins.
  HWY_INLINE VI FirstSegment(const DensityInCell& density) const {
    const VF front = density.At(Set(-1));
    const VI segment = SegmentOf(*f_.curve, hn::Add(density.base, front));
    // Rounding of the sum may have reached the point of the curve where the segment begins.
    const MF isBefore = hn::Lt(front, hn::Sub(LowOf(*f_.curve, segment), density.base));
    return hn::Sub(segment, hn::IfThenElseZero(hn::RebindMask(DI(), isBefore), SetI(1)));
  }

  /// Returns the next length to try. The rule's error grows with the cube of a part's length.
  static HWY_INLINE VF NextLength(VF length, VF off, VF share) {
    const VF ratio = hn::Div(share, hn::Max(off, Set(1e-30f)));
    const VF shrink = hn::Min(hn::Max(hn::Sqrt(ratio), Set(0.125f)), Set(0.5f));
    return hn::Mul(length, shrink);
  }

  /// Begins a piece in the lanes `which`.
  HWY_INLINE void NextPiece(MF which, PassageLanes& lanes) const {
    Piece& p = lanes.piece;
    p.index = hn::Add(p.index, hn::IfThenElseZero(hn::RebindMask(DI(), which), p.step));
    SetPiece(lanes.r, lanes.s, which, p);
    lanes.length = hn::IfThenElse(which, Set(2), lanes.length);
    lanes.front = rule_.FragmentAt(lanes.r, p.segment, lanes.s);
  }

  /// Finds the roots of the derivative inside the passage.
  static HWY_INLINE void SetTurns(const Cubic& c, Piece& p) {
    const DF df;
    const VF none = Set(2);
    // Solves 3 c3 s^2 + 2 c2 s + c1 = 0. The forms q / (3 c3) and c1 / q lose no digits where one root is
    // much larger.
    const VF a = hn::Mul(Set(3), c.c3), square = hn::Sub(hn::Mul(c.c2, c.c2), hn::Mul(a, c.c1));
    const VF root = hn::Sqrt(hn::Max(square, hn::Zero(df)));
    const VF q = hn::Neg(hn::Add(c.c2, hn::CopySign(root, c.c2)));
    const auto inside = [&](VF over, VF under) {
      const VF at = hn::Div(over, NotZero(under));
      const MF is = hn::And(hn::Lt(hn::Abs(at), Set(1)), hn::Gt(square, hn::Zero(df)));
      return hn::IfThenElse(is, at, none);
    };
    const VF t1 = inside(q, a), t2 = inside(c.c1, q);
    p.turn1 = hn::Min(t1, t2);
    p.turn2 = hn::Max(t1, t2);
  }

  /// Finds the piece that begins at s. It ends where the density turns or crosses a point of the curve,
  /// whichever is first.
  HWY_INLINE void SetPiece(const RayInCell& r, VF s, MF which, Piece& p) const {
    const DF df;
    const DI di;
    const VF one = Set(1);
    p.segment = CountedFrom(r.density.base, SegmentAt(*f_.curve, p.index));
    const VF turn = hn::IfThenElse(hn::Lt(s, p.turn1), p.turn1, p.turn2);
    const VF monotone = hn::IfThenElse(hn::Lt(s, turn), hn::Min(turn, one), one);
    const VF atEnd = r.density.At(monotone);
    const MF up = hn::And(which, hn::Gt(atEnd, p.segment.high)),
             down = hn::And(which, hn::Lt(atEnd, p.segment.low));
    const MF crosses = hn::Or(up, down);
    VF end = monotone;
    if (!hn::AllFalse(df, crosses)) {
      const VF node = hn::IfThenElse(up, p.segment.high, p.segment.low);
      end = hn::IfThenElse(crosses, CrossingOf(r.density.along, s, monotone, node, up, crosses), end);
    }
    const VI step = hn::IfThenElse(hn::RebindMask(di, up), SetI(1),
                                   hn::IfThenElseZero(hn::RebindMask(di, down), SetI(-1)));
    p.step = hn::IfThenElse(hn::RebindMask(di, which), step, p.step);
    p.end = hn::IfThenElse(which, end, p.end);
  }

  /// Returns where a density that rises (`up`) or falls between `from` and `to` reaches `node`. Uses Newton's
  /// method with bisection where a step leaves the bracket.
  HWY_INLINE VF CrossingOf(const Cubic& c, VF from, VF to, VF node, MF up, MF which) const {
    const DF df;
    VF low = from, high = to;
    const VF first = c.At(from), rise = hn::Sub(c.At(to), first);
    const VF share = hn::Div(hn::Sub(node, first), NotZero(rise));
    VF s = hn::Add(from, hn::Mul(Clamp01(share), hn::Sub(to, from)));
    MF moves = which;
    constexpr int most = 24;
    for (int n = 0; n < most && !hn::AllFalse(df, moves); ++n) {
      const VF value = hn::Sub(c.At(s), node), above = hn::IfThenElse(up, value, hn::Neg(value));
      const MF before = hn::Lt(above, hn::Zero(df));
      low = hn::IfThenElse(before, s, low);
      high = hn::IfThenElse(before, high, s);
      const VF newton = hn::Sub(s, hn::Div(value, NotZero(c.RiseAt(s))));
      const MF within = hn::And(hn::Ge(newton, low), hn::Le(newton, high));
      const VF next = hn::IfThenElse(within, newton, hn::Mul(Set(0.5f), hn::Add(low, high)));
      const VF move = hn::Abs(hn::Sub(next, s));
      s = hn::IfThenElse(moves, next, s);
      moves = hn::And(moves, hn::Gt(move, Set(1e-6f)));
    }
    return s;
  }

  const RayInputs& f_;
  const PartRule<Material> rule_;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
