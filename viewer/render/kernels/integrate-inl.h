// Integration of rays cell by cell with local error control, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_INTEGRATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_INTEGRATE_INL_H_
#undef VOLUMEN_RENDER_KERNELS_INTEGRATE_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_INTEGRATE_INL_H_
#endif

#include "viewer/render/kernels/part-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// What the passage of a ray through a cell comes to in light that is 1 in front of it.
struct PassageSum {
  V3 colour;  ///< premultiplied
  VF opacity, error;
};

/// Integrates passages from their front to their back, a lane each. Each is cut exactly where its density
/// turns round and where it crosses a point of the curve; what lies between two cuts, a piece, holds no kink
/// of the curve. A piece is integrated in parts (PartRule): a part is cut further while what it may be
/// off by, times the light that reaches it, is more than its share of the budget (ErrorBudget).
template <class Material>
class PassageIntegrator {
 public:
  PassageIntegrator(const TraceFrame& f, const Material& matter) : f_(f), rule_(matter) {}

  /// `through`: the light that reaches each passage; `active`: the lanes that hold one.
  HWY_INLINE PassageSum Integrate(const RayInCell& r, VF through, MF active, std::int64_t& parts) const {
    const DF df;
    const VF one = Set(1), zero = hn::Zero(df);
    const ErrorBudget& budget = f_.budget;
    const VF least = Set(budget.most * budget.leastShare);
    PassageSum sum{Zero3(), zero, zero};
    VF left = one;
    Piece piece = FirstPiece(r, active);
    VF s = Set(-1), length = Set(2);
    Lit front = rule_.ColourAt(r, piece.segment, s);
    while (!hn::AllFalse(df, active)) {
      const VF end = hn::Add(s, length);
      const MF nearEnd = hn::Ge(hn::Add(end, hn::Mul(length, Set(0.1f))), piece.end);
      const VF upTo = hn::IfThenElse(nearEnd, piece.end, end);
      const VF reach = hn::Mul(through, left);
      const Lit back = rule_.ColourAt(r, piece.segment, upTo);
      const PartSum part = rule_.Integrate(r, {s, upTo, piece.segment}, front, back);
      const VF off = hn::Mul(reach, part.error), weight = hn::Mul(reach, part.opacity);
      const VF share = hn::Max(hn::Mul(Set(budget.most), weight), least);
      const MF tooFar = hn::And(hn::Gt(off, share), hn::Gt(hn::Sub(upTo, s), Set(kShortest)));
      const MF taken = hn::AndNot(tooFar, active);
      parts += std::int64_t(hn::CountTrue(df, taken));
      const VF seen = hn::IfThenElseZero(taken, left);
      sum.colour = Add(sum.colour, Scale(part.colour, seen));
      sum.error = hn::Add(sum.error, hn::Mul(seen, part.error));
      left = hn::Sub(left, hn::Mul(seen, part.opacity));
      const MF ends = hn::And(taken, nearEnd);
      length = hn::IfThenElse(taken, hn::Add(length, length), NextLength(hn::Sub(upTo, s), off, share));
      s = hn::IfThenElse(taken, upTo, s);
      front = {IfThenElse3(taken, back.colour, front.colour), IfThenElse3(taken, back.normal, front.normal),
               hn::IfThenElse(hn::RebindMask(DI(), taken), back.sides, front.sides)};
      const MF goesOn =
          hn::And(hn::Or(tooFar, hn::Lt(s, one)), hn::Gt(hn::Mul(through, left), Set(f_.stopTransmittance)));
      active = hn::And(active, goesOn);
      const MF turns = hn::And(ends, active);
      if (hn::AllFalse(df, turns)) continue;
      NextPiece(r, s, turns, piece);
      length = hn::IfThenElse(turns, Set(2), length);
      front = rule_.ColourAt(r, piece.segment, s);
    }
    sum.opacity = hn::Sub(one, left);
    return sum;
  }

 private:
  static constexpr float kShortest = 1.0f / 2048;  ///< parts are not cut further

  /// What lies between two cuts of a passage.
  struct Piece {
    VF turn1, turn2;  ///< where the density turns round; 2: nowhere
    VI index;         ///< segment of the curve
    CurveSegment segment;
    VF end;
    VI step;  ///< from the segment to the next piece's: -1, 0, 1
  };

  /// A rule that is off by the cube of a part's length: how long one may be.
  static HWY_INLINE VF NextLength(VF length, VF off, VF share) {
    const VF ratio = hn::Div(share, hn::Max(off, Set(1e-30f)));
    const VF shrink = hn::Min(hn::Max(hn::Sqrt(ratio), Set(0.125f)), Set(0.5f));
    return hn::Mul(length, shrink);
  }

  HWY_INLINE Piece FirstPiece(const RayInCell& r, MF active) const {
    Piece p;
    SetTurns(r.density, p);
    p.index = SegmentOf(*f_.curve, r.density.At(Set(-1)));
    p.step = SetI(0);
    p.end = Set(-1);
    SetPiece(r, Set(-1), active, p);
    return p;
  }

  HWY_INLINE void NextPiece(const RayInCell& r, VF s, MF which, Piece& p) const {
    p.index = hn::Add(p.index, hn::IfThenElseZero(hn::RebindMask(DI(), which), p.step));
    SetPiece(r, s, which, p);
  }

  /// The roots of the derivative inside the passage.
  static HWY_INLINE void SetTurns(const Cubic& c, Piece& p) {
    const DF df;
    const VF none = Set(2);
    // 3 c3 s^2 + 2 c2 s + c1 = 0: q / (3 c3) and c1 / q lose no digits where one is much larger.
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

  /// The piece from s on: to where the density turns round, or crosses a point of the curve before.
  HWY_INLINE void SetPiece(const RayInCell& r, VF s, MF which, Piece& p) const {
    const DF df;
    const DI di;
    const VF one = Set(1);
    p.segment = SegmentAt(*f_.curve, p.index);
    const VF turn = hn::IfThenElse(hn::Lt(s, p.turn1), p.turn1, p.turn2);
    const VF monotone = hn::IfThenElse(hn::Lt(s, turn), hn::Min(turn, one), one);
    const VF atEnd = r.density.At(monotone);
    const MF up = hn::And(which, hn::Gt(atEnd, p.segment.high)),
             down = hn::And(which, hn::Lt(atEnd, p.segment.low));
    const MF crosses = hn::Or(up, down);
    VF end = monotone;
    if (!hn::AllFalse(df, crosses)) {
      const VF node = hn::IfThenElse(up, p.segment.high, p.segment.low);
      end = hn::IfThenElse(crosses, CrossingOf(r.density, s, monotone, node, up, crosses), end);
    }
    const VI step = hn::IfThenElse(hn::RebindMask(di, up), SetI(1),
                                   hn::IfThenElseZero(hn::RebindMask(di, down), SetI(-1)));
    p.step = hn::IfThenElse(hn::RebindMask(di, which), step, p.step);
    p.end = hn::IfThenElse(which, end, p.end);
  }

  /// Where a density that rises (`up`) or falls from `from` to `to` reaches `node`: Newton's steps, bisection
  /// where they leave the bracket.
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

  const TraceFrame& f_;
  const PartRule<Material> rule_;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
