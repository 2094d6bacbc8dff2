// The two rules that integrate a part of a ray, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_PART_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_PART_INL_H_
#undef VOLUMEN_RENDER_KERNELS_PART_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_PART_INL_H_
#endif

#include "viewer/render/kernels/extinction-inl.h"
#include "viewer/render/kernels/matter-inl.h"
#include "viewer/render/kernels/passage-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// A ray inside one cell: density and stored gradient along it (Cubic), and how long it is there.
struct RayInCell {
  Cubic density;
  CubicVector gradient;  ///< where the material asks for gradients
  VF units;              ///< from -1 to 1, in unit distances
  VI ray;
};

/// A part of it, from `a` to `b`, on which the density rises or falls along one segment of the curve.
struct Part {
  VF a, b;
  CurveSegment segment;
};

/// What a part comes to in light that is 1 in front of it.
struct PartSum {
  V3 colour;  ///< premultiplied
  VF opacity;
  VF error;  ///< how far a component may be off
};

/// Integrates parts by an embedded pair of rules. Either takes the opacity between its densities to rise
/// straight, integrates the extinction in closed form (pre-integration; Engel, Kraus and Ertl 2001) and takes
/// the colour from where the light comes from in the mean; the coarse one of the whole part, the fine one of
/// its halves. Both are off by the square of the part's length, so a third of what they differ by is what the
/// fine one is off by; that is added (Richardson's extrapolation).
template <class Material>
class PartRule {
 public:
  explicit PartRule(const Material& matter) : matter_(matter) {}

  /// `reach`: the light that reaches the part; of less light than `few` one colour is enough.
  HWY_INLINE PartSum Integrate(const RayInCell& r, const Part& p, VF reach, VF few) const {
    const VF half = Set(0.5f), one = Set(1), zero = hn::Zero(DF());
    const VF middle = hn::Mul(half, hn::Add(p.a, p.b));
    const Extinction a = ExtinctionAt(r, p, p.a), m = ExtinctionAt(r, p, middle), b = ExtinctionAt(r, p, p.b);
    const VF units = hn::Mul(hn::Mul(r.units, half), hn::Sub(p.b, p.a)), halfUnits = hn::Mul(units, half);
    const Slab whole = SlabOf(a, b, units), front = SlabOf(a, m, halfUnits), back = SlabOf(m, b, halfUnits);
    const VF seenBack = hn::Mul(hn::Sub(one, front.opacity), back.opacity);
    const VF fine = hn::Add(front.opacity, seenBack), differ = hn::Sub(fine, whole.opacity);
    PartSum sum{Zero3(), Clamp01(hn::Add(fine, ThirdOf(differ))), ThirdOf(hn::Abs(differ))};
    if constexpr (Material::kFactors) sum.error = hn::Add(sum.error, MissedFactors(r, p, halfUnits));
    if (hn::AllFalse(DF(), hn::Gt(fine, zero))) return sum;
    const Lit ofWhole = ColourAt(r, p, Between(p.a, p.b, whole.centroid));
    const MF fully = hn::Gt(hn::Mul(reach, fine), few);
    if (hn::AllFalse(DF(), fully)) {
      sum.colour = Scale(ofWhole.colour, sum.opacity);
      return sum;
    }
    const Lit first = ColourAt(r, p, Between(p.a, middle, front.centroid)),
              second = ColourAt(r, p, Between(middle, p.b, back.centroid));
    const VF bias = hn::Mul(fine, whole.bias);
    VF off = zero;
    if constexpr (Material::kLit) off = hn::Mul(fine, MissedLight(first, ofWhole, second));
    const auto component = [&](VF c, VF c1, VF c2) {
      const VF halves = hn::Add(hn::Mul(c1, front.opacity), hn::Mul(c2, seenBack));
      const VF third = ThirdOf(hn::Sub(halves, hn::Mul(c, whole.opacity)));
      off = hn::Max(off, hn::Add(hn::Abs(third), hn::Mul(bias, hn::Abs(hn::Sub(c2, c1)))));
      return hn::IfThenElse(fully, hn::Max(hn::Add(halves, third), zero), hn::Mul(c, sum.opacity));
    };
    sum.colour.x = component(ofWhole.colour.x, first.colour.x, second.colour.x);
    sum.colour.y = component(ofWhole.colour.y, first.colour.y, second.colour.y);
    sum.colour.z = component(ofWhole.colour.z, first.colour.z, second.colour.z);
    sum.error = hn::IfThenElse(fully, hn::Max(sum.error, off), sum.error);
    return sum;
  }

 private:
  /// 1 - opacity and -ln of it, a unit distance each.
  struct Extinction {
    VF transparency, extinction;
  };
  /// What lies between two places: its opacity; where its light comes from in the mean, 0..1; and how far
  /// that may be off, as a share of the way from the front half's to the back half's.
  struct Slab {
    VF opacity, centroid, bias;
  };

  static HWY_INLINE VF ThirdOf(VF v) { return hn::Mul(v, Set(1.0f / 3)); }
  static HWY_INLINE VF Between(VF a, VF b, VF share) { return hn::Add(a, hn::Mul(share, hn::Sub(b, a))); }

  HWY_INLINE VF DensityAt(const RayInCell& r, const Part& p, VF s) const {
    return hn::Min(hn::Max(r.density.At(s), p.segment.low), p.segment.high);
  }

  HWY_INLINE Extinction ExtinctionAt(const RayInCell& r, const Part& p, VF s) const {
    VF opacity = OpacityOn(p.segment, DensityAt(r, p, s));
    if constexpr (Material::kFactors) opacity = hn::Mul(opacity, matter_.FactorAt(r.gradient.At(s)));
    const Transparency t = TransparencyOf(opacity);
    return {t.left, hn::Neg(t.log)};
  }

  HWY_INLINE Lit ColourAt(const RayInCell& r, const Part& p, VF s) const {
    V3 gradient = Zero3();
    if constexpr (Material::kLit) gradient = r.gradient.At(s);
    return matter_.LitColour(ColourOn(p.segment, DensityAt(r, p, s)), gradient, r.ray);
  }

  /// The light that may have come and gone between three places: by how far the normal turns on the way.
  HWY_INLINE VF MissedLight(const Lit& a, const Lit& m, const Lit& b) const {
    const auto turned = [](const V3& u, const V3& v) {
      const V3 change = Add(u, Scale(v, Set(-1)));
      return Dot(change, change);
    };
    const VF turn = hn::Max(turned(a.normal, m.normal), turned(m.normal, b.normal));
    const LightTurn& light = matter_.f.lightTurn;
    // A highlight is so wide that a turn of 1 / sqrt(shininess) may step over a part of it.
    const VF over = hn::Mul(turn, Set(light.shininess)), square = hn::Mul(over, over);
    const VF shine = hn::Div(hn::Min(square, Set(1)), hn::Sqrt(hn::Max(over, Set(1))));
    return hn::Add(hn::Mul(Set(light.diffuse), turn), hn::Mul(Set(light.specular), shine));
  }

  /// The centroid is that of Simpson's rule over the transmittance T: (integral of T - T at the back) /
  /// opacity, with the depth of the front half as if the extinction rose straight. The bias is a bound on
  /// what was found for opacities of 0 to 1 - 2^-20 at either end and depths of 0 to 20 (tests, part rule).
  static HWY_INLINE Slab SlabOf(const Extinction& a, const Extinction& b, VF units) {
    const VF zero = hn::Zero(DF()), e1 = a.extinction, sum = hn::Add(e1, b.extinction);
    const VF mean = MeanOnSegment(a.transparency, e1, b.transparency, b.extinction);
    const VF depth = hn::Mul(units, mean), opacity = OpacityOfDepth(depth);
    const VF share = hn::Div(hn::Add(hn::Add(e1, e1), sum), NotZero(hn::Mul(Set(4), sum)));
    const VF half = OpacityOfDepth(hn::Mul(depth, share));
    const VF hidden = hn::Div(half, NotZero(opacity));
    const VF centroid = hn::IfThenElse(hn::Gt(opacity, zero),
                                       hn::Sub(Set(5.0f / 6), hn::Mul(Set(2.0f / 3), hidden)), Set(0.5f));
    const VF bent =
        hn::Div(hn::Abs(hn::Sub(sum, hn::Add(mean, mean))), NotZero(hn::Add(sum, hn::Add(mean, mean))));
    const VF bias = hn::Min(Set(0.12f), hn::Add(hn::Mul(Set(0.012f), depth), hn::Mul(Set(0.1f), bent)));
    return {opacity, centroid, bias};
  }

  /// The opacity that factors over the gradient may add or take between the places where they were looked at:
  /// by how far |g| may go within each half and how much the factor changes there.
  HWY_INLINE VF MissedFactors(const RayInCell& r, const Part& p, VF halfUnits) const {
    const VF half = Set(0.5f), middle = hn::Mul(half, hn::Add(p.a, p.b));
    const VF length = hn::Mul(half, hn::Sub(p.b, p.a));
    const V3 g[3] = {GradientMm(r, p.a), GradientMm(r, middle), GradientMm(r, p.b)};
    // A curve leaves its chord by no more than an eighth of its second derivative times the square of its
    // length.
    const VF bend = hn::Max(Length(InMm(r.gradient.SecondAt(p.a))), Length(InMm(r.gradient.SecondAt(p.b))));
    const VF leaves = hn::Mul(Set(0.125f), hn::Mul(bend, hn::Mul(length, length)));
    VF missed = hn::Zero(DF());
    for (int n = 0; n < 2; ++n) {
      const VF most = hn::Add(hn::Max(Length(g[n]), Length(g[n + 1])), leaves);
      const VF least = hn::Max(hn::Sub(LeastOnChord(g[n], g[n + 1]), leaves), hn::Zero(DF()));
      const VF change =
          hn::Sub(FactorVariation(*matter_.f.transfer, most), FactorVariation(*matter_.f.transfer, least));
      const VF seen = hn::Abs(hn::Sub(GradientFactor(*matter_.f.transfer, Length(g[n])),
                                      GradientFactor(*matter_.f.transfer, Length(g[n + 1]))));
      missed = hn::Add(missed, hn::Max(hn::Sub(change, seen), hn::Zero(DF())));
    }
    // -ln(1 - f opacity) <= -f ln(1 - opacity); along half of the way, in the mean.
    const VF opacity =
        hn::Max(OpacityOn(p.segment, DensityAt(r, p, p.a)), OpacityOn(p.segment, DensityAt(r, p, p.b)));
    const VF extinction = hn::Neg(TransparencyOf(opacity).log);
    return OpacityOfDepth(hn::Mul(hn::Mul(halfUnits, half), hn::Mul(extinction, missed)));
  }

  /// A stored gradient in value per mm.
  HWY_INLINE V3 InMm(const V3& stored) const {
    return Scale(InPatient(matter_.f, stored), Set(matter_.f.gradientUnit));
  }
  HWY_INLINE V3 GradientMm(const RayInCell& r, VF s) const { return InMm(r.gradient.At(s)); }

  /// The least length between two vectors.
  static HWY_INLINE VF LeastOnChord(const V3& a, const V3& b) {
    const V3 chord = Add(b, Scale(a, Set(-1)));
    const VF at = Clamp01(hn::Div(hn::Neg(Dot(a, chord)), NotZero(Dot(chord, chord))));
    return Length(Add(a, Scale(chord, at)));
  }

  const Material& matter_;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
