// The two rules that integrate a part of a ray. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_PART_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_PART_INL_H_
#undef VOLUMEN_KERNELS_PART_INL_H_
#else
#define VOLUMEN_KERNELS_PART_INL_H_
#endif

#include <algorithm>

#include "viewer/kernels/classify_and_light-inl.h"
#include "viewer/kernels/extinction-inl.h"
#include "viewer/kernels/passage-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// A ray inside one cell: density and stored gradient along it, and its length there.
struct RayInCell {
  DensityInCell density;
  CubicVector gradient;  ///< Set only if the material needs gradients.
  VF unitDistances;      ///< Length from s = -1 to s = 1, in unit distances.
  VI ray;
};
HWY_INLINE RayInCell Chosen(MF which, const RayInCell& a, const RayInCell& b) {
  return {Chosen(which, a.density, b.density),
          {Chosen(which, a.gradient.x, b.gradient.x), Chosen(which, a.gradient.y, b.gradient.y),
           Chosen(which, a.gradient.z, b.gradient.z)},
          hn::IfThenElse(which, a.unitDistances, b.unitDistances),
          hn::IfThenElse(hn::RebindMask(DI(), which), a.ray, b.ray)};
}

/// The part of it from `a` to `b`. There the density rises or falls along one segment of the curve. The
/// segment, too, counts from the density's base.
struct Part {
  VF a, b;
  CurveSegment segment;
};

/// Result of a part, for light of strength 1 in front of it.
struct PartSum {
  V3 colour;  ///< Premultiplied.
  VF opacity;
  VF error;  ///< Bound on the error of a component.
};

/// Integrates parts, opacity correction included, by an embedded pair of rules.
/// Opacity: between two positions opacity is taken as linear and extinction integrated in closed form
/// (pre-integration; Engel, Kraus and Ertl 2001). This is done over the whole part and over its halves. A
/// third of the difference is the error of the halves and is added (Richardson extrapolation).
/// Colour: the colour at the mean position of the light, and a parabola through it and both ends. The
/// parabola is integrated with the light's mean and variance.
template <class Material>
class PartRule {
  static constexpr float kOffOfBent = 0.4f;  ///< Error of the parabola, as a share of its contribution.

 public:
  explicit PartRule(const Material& matter) : material_(matter) {}

  HWY_INLINE Fragment FragmentAt(const RayInCell& r, const CurveSegment& segment, VF s) const {
    V3 gradient = Zero3();
    if constexpr (Material::kLit) gradient = r.gradient.At(s);
    return material_.FragmentOf(ColourOn(segment, DensityOn(r, segment, s)), gradient, r.ray);
  }

  /// `front`, `back`: fragments at the ends. `reach`: light that reaches the part.
  HWY_INLINE PartSum Integrate(const RayInCell& r, const Part& p, const Fragment& front, const Fragment& back,
                               VF reach) const {
    const VF half = Set(0.5f), one = Set(1);
    const VF middle = hn::Mul(half, hn::Add(p.a, p.b));
    const Place places[3] = {PlaceAt(r, p, p.a), PlaceAt(r, p, middle), PlaceAt(r, p, p.b)};
    const Extinction &a = places[0].extinction, &m = places[1].extinction, &b = places[2].extinction;
    const VF unitDistances = hn::Mul(hn::Mul(r.unitDistances, half), hn::Sub(p.b, p.a)),
             halfUnits = hn::Mul(unitDistances, half);
    const VF mean = MeanOf(a, b), depth = hn::Mul(unitDistances, mean);
    const PartOpacity first = OpacityOfPart(a, m, halfUnits), second = OpacityOfPart(m, b, halfUnits);
    const VF behind = hn::Mul(hn::Sub(one, first.opacity), second.opacity);
    const VF opacity = hn::Add(first.opacity, behind);
    const VF third = hn::Mul(hn::Sub(opacity, OpacityOfDepth(depth)), Set(1.0f / 3));
    PartSum sum{Zero3(), Clamp01(hn::Add(opacity, third)), hn::Abs(third)};
    if constexpr (Material::kFactors) sum.error = hn::Add(sum.error, MissedFactors(r, p, places, halfUnits));
    // Smaller divisors do not fit into a float, and such parts show nothing.
    const VF per = hn::Div(one, hn::Max(opacity, Set(1e-30f)));
    const VF at1 = hn::Mul(half, first.centroid), at2 = hn::Mul(half, hn::Add(one, second.centroid));
    const VF at = hn::Mul(hn::Add(hn::Mul(first.opacity, at1), hn::Mul(behind, at2)), per);
    const VF d1 = hn::Sub(at1, at), d2 = hn::Sub(at2, at);
    const VF between =
        hn::Mul(hn::Add(hn::Mul(first.opacity, hn::Mul(d1, d1)), hn::Mul(behind, hn::Mul(d2, d2))), per);
    const Spread light{at, hn::Add(between, WithinHalves(depth)), BiasOf(a, b, mean, depth)};
    AddColour(r, light, front, FragmentAt(r, p.segment, Between(p.a, p.b, light.mean)), back, reach, sum);
    return sum;
  }

  /// Returns the error allowed to a part of this opacity that `reach` reaches, as a share of white.
  HWY_INLINE VF ShareOf(VF reach, VF opacity) const {
    const ErrorBudget& budget = material_.f.budget;
    return hn::Max(hn::Mul(Set(budget.most), hn::Mul(reach, opacity)), Set(budget.most * budget.leastShare));
  }

 private:
  /// 1 - opacity and its -ln, both per unit distance.
  struct Extinction {
    VF transparency, extinction;
  };
  /// `factor` and `gradient` are set only if opacity depends on gradients. The gradient is in factorUnits.
  struct Place {
    Extinction extinction;
    VF opacity, factor;  ///< `opacity`: of the curve alone.
    V3 gradient;
  };
  /// Opacity between two positions, and the mean position of its light, 0..1.
  struct PartOpacity {
    VF opacity, centroid;
  };
  /// Origin of the light of a part, 0..1 of its length: mean, variance, and bound on the error of the mean.
  struct Spread {
    VF mean, variance, bias;
  };

  static HWY_INLINE VF DensityOn(const RayInCell& r, const CurveSegment& segment, VF s) {
    return hn::Min(hn::Max(r.density.At(s), segment.low), segment.high);
  }
  HWY_INLINE Place PlaceAt(const RayInCell& r, const Part& p, VF s) const {
    Place place;
    place.opacity = OpacityOn(p.segment, DensityOn(r, p.segment, s));
    VF opacity = place.opacity;
    if constexpr (Material::kFactors) {
      const V3 stored = r.gradient.At(s);
      place.gradient = InFactorUnits(stored);
      place.factor = material_.FactorAt(stored);
      opacity = hn::Mul(opacity, place.factor);
    }
    const Transparency t = TransparencyOf(opacity);
    place.extinction = {t.left, hn::Neg(t.log)};
    return place;
  }

  /// Deviation of a value from the straight line between the ends of a part.
  struct Bend {
    VF bent;  ///< Mean seen by the light minus the value at the mean position, by a parabola.
    VF rise;  ///< The larger of the two slopes.
  };
  struct BendRule {
    VF toFront, toBack, variance;

    explicit HWY_INLINE BendRule(const Spread& light) : variance(light.variance) {
      // Divided differences. Light that comes from one end has almost no variance.
      const VF one = Set(1), least = Set(0.01f);
      toFront = hn::Div(one, hn::Max(light.mean, least));
      toBack = hn::Div(one, hn::Max(hn::Sub(one, light.mean), least));
    }
    HWY_INLINE Bend operator()(VF front, VF middle, VF back) const {
      const VF rise0 = hn::Mul(hn::Sub(middle, front), toFront),
               rise1 = hn::Mul(hn::Sub(back, middle), toBack);
      return {hn::Mul(hn::Sub(rise1, rise0), variance), hn::Max(hn::Abs(rise0), hn::Abs(rise1))};
    }
  };

  /// Computes colour and its error. Uses the light at the mean position alone if that is accurate enough,
  /// else also the light at the ends.
  HWY_INLINE void AddColour(const RayInCell& r, const Spread& light, const Fragment& front,
                            const Fragment& middle, const Fragment& back, VF reach, PartSum& sum) const {
    const BendRule bend(light);
    V3 colour = material_.LitColour(middle, r.ray);
    const VF brightest = hn::Max(Set(1), hn::Max(colour.x, hn::Max(colour.y, colour.z)));
    sum.error = hn::Mul(sum.error, brightest);
    const VF missed = MissedLight(front, middle, back);
    VF off = hn::Add(missed, OffInMiddle(light, bend, front, middle, back));
    const VF allowed = ShareOf(reach, sum.opacity);
    const MF needsEnds = hn::Gt(hn::Mul(reach, hn::Add(sum.error, hn::Mul(sum.opacity, off))), allowed);
    if (!hn::AllFalse(DF(), needsEnds)) {
      V3 better = colour;
      const VF offBetter =
          AddBend(light, bend, material_.LitColour(front, r.ray), material_.LitColour(back, r.ray), better);
      colour = IfThenElse3(needsEnds, better, colour);
      off = hn::IfThenElse(needsEnds, hn::Add(missed, offBetter), off);
    }
    sum.error = hn::Add(sum.error, hn::Mul(sum.opacity, off));
    sum.colour = Scale(colour, sum.opacity);
  }

  /// Adds the parabola's contribution to the colour at the mean position. Returns its possible error.
  static HWY_INLINE VF AddBend(const Spread& light, const BendRule& bend, const V3& front, const V3& back,
                               V3& colour) {
    VF off = hn::Zero(DF());
    const auto component = [&](VF c0, VF& c, VF c1) {
      const Bend b = bend(c0, c, c1);
      off = hn::Max(off, hn::Add(hn::Mul(Set(kOffOfBent), hn::Abs(b.bent)), hn::Mul(light.bias, b.rise)));
      c = hn::Max(hn::Add(c, b.bent), hn::Zero(DF()));
    };
    component(front.x, colour.x, back.x);
    component(front.y, colour.y, back.y);
    component(front.z, colour.z, back.z);
    return off;
  }

  /// Returns the error of the light at the mean position that the curve and the normals cause along the part.
  HWY_INLINE VF OffInMiddle(const Spread& light, const BendRule& bend, const Fragment& front,
                            const Fragment& middle, const Fragment& back) const {
    const LightStrength& strength = material_.f.lightStrength;
    const auto off = [&](VF a, VF m, VF b) {
      const Bend x = bend(a, m, b);
      return hn::Add(hn::Abs(x.bent), hn::Mul(light.bias, x.rise));
    };
    const VF colour = hn::Max(hn::Max(off(front.colour.x, middle.colour.x, back.colour.x),
                                      off(front.colour.y, middle.colour.y, back.colour.y)),
                              off(front.colour.z, middle.colour.z, back.colour.z));
    const VF ofColour = hn::Mul(Set(strength.ambient + strength.diffuse), colour);
    if constexpr (!Material::kLit) return ofColour;
    const auto ofNormal = [&](VF a, VF m, VF b) {
      return off(hn::Mul(a, front.share), hn::Mul(m, middle.share), hn::Mul(b, back.share));
    };
    const V3 turn{ofNormal(front.normal.x, middle.normal.x, back.normal.x),
                  ofNormal(front.normal.y, middle.normal.y, back.normal.y),
                  ofNormal(front.normal.z, middle.normal.z, back.normal.z)};
    // Wide highlights change as evenly as diffuse light; narrow ones are seldom met.
    const VF ofNormals = Length(turn);
    const V3 way = Add(back.normal, Scale(front.normal, Set(-1)));
    const VF highlight = hn::Add(hn::Mul(Set(std::min(strength.shininess, 4.0f)), ofNormals),
                                 hn::Mul(Set(strength.shininess / 24), Dot(way, way)));
    return hn::Add(hn::Add(ofColour, hn::Mul(Set(strength.diffuse), ofNormals)),
                   hn::Mul(Set(strength.specular), hn::Min(highlight, Set(1))));
  }

  /// Returns the light that may have come and gone between three positions. It depends on how far the normal
  /// turns and whether it passes a kink of the light.
  HWY_INLINE VF MissedLight(const Fragment& a, const Fragment& m, const Fragment& b) const {
    if constexpr (!Material::kLit) return hn::Zero(DF());
    return hn::Max(MissedBetween(a, m), MissedBetween(m, b));
  }
  HWY_INLINE VF MissedBetween(const Fragment& a, const Fragment& b) const {
    const LightStrength& light = material_.f.lightStrength;
    const V3 change = Add(Scale(a.normal, a.share), Scale(b.normal, hn::Neg(b.share)));
    const VF square = Dot(change, change), turn = hn::Sqrt(square);
    // A highlight is so wide that a turn of 1 / sqrt(shininess) may step over part of it.
    const VF over = hn::Mul(square, Set(0.5f * light.shininess));
    const VF shine = hn::Div(hn::Min(hn::Mul(over, over), Set(1)), hn::Sqrt(hn::Max(over, Set(1))));
    const VF smooth =
        hn::Add(hn::Mul(Set(0.05f * light.diffuse), square), hn::Mul(Set(0.25f * light.specular), shine));
    const VI sides = hn::Xor(a.sides, b.sides);
    if (hn::AllTrue(DI(), hn::Eq(sides, SetI(0)))) return smooth;
    // Light changes from none to full within a tenth of a turn where highlights begin. It also does between
    // the two sides of a surface that a viewer may see.
    const auto passes = [&](VI bits) { return hn::RebindMask(DF(), hn::Ne(bits, SetI(0))); };
    const VF sudden = hn::Mul(Set(0.25f), hn::Min(hn::Mul(Set(5), turn), Set(1)));
    // Each kink belongs to one light.
    const VF kinksPassed =
        hn::ConvertTo(DF(), hn::BitCast(DI(), hn::PopulationCount(hn::BitCast(hn::RebindToUnsigned<DI>(),
                                                                              hn::AndNot(SetI(3), sides)))));
    const LightStrength& one = material_.f.strongestLight;
    const auto ofKinks = [&](float strongest, float all) {
      return hn::Min(hn::Mul(kinksPassed, Set(strongest)), Set(all));
    };
    const VF ofLights = hn::Add(hn::Mul(hn::Mul(Set(0.125f), ofKinks(one.diffuse, light.diffuse)), turn),
                                hn::Mul(ofKinks(one.specular, light.specular), sudden));
    const VF ofSides = hn::Mul(Set(light.diffuse + light.specular), sudden);
    const VF kinks =
        hn::IfThenElse(passes(hn::And(sides, SetI(3))), ofSides, hn::IfThenElseZero(passes(sides), ofLights));
    return hn::Add(smooth, kinks);
  }

  static HWY_INLINE VF MeanOf(const Extinction& a, const Extinction& b) {
    return MeanOnSegment(a.transparency, a.extinction, b.transparency, b.extinction);
  }

  /// Computes the centroid by Simpson's rule over the transmittance T: (integral of T - T at the back) /
  /// opacity. The depth of the front half assumes linear extinction. Behind almost opaque parts the centroid
  /// is where the depth is 1.
  static HWY_INLINE PartOpacity OpacityOfPart(const Extinction& a, const Extinction& b, VF unitDistances) {
    const VF e1 = a.extinction, sum = hn::Add(e1, b.extinction);
    const VF depth = hn::Mul(unitDistances, MeanOf(a, b)), opacity = OpacityOfDepth(depth);
    const VF share = hn::Div(hn::Add(hn::Add(e1, e1), sum), NotZero(hn::Mul(Set(4), sum)));
    const VF hidden = hn::Div(OpacityOfDepth(hn::Mul(depth, share)), NotZero(opacity));
    VF centroid = hn::Sub(Set(5.0f / 6), hn::Mul(Set(2.0f / 3), hidden));
    if (!hn::AllFalse(DF(), hn::Gt(depth, Set(4)))) {
      const VF steady = hn::Mul(unitDistances, e1), rise = hn::Mul(unitDistances, hn::Sub(b.extinction, e1));
      const VF square = hn::Max(hn::Add(hn::Mul(steady, steady), hn::Add(rise, rise)), hn::Zero(DF()));
      const VF at = hn::Div(Set(2), NotZero(hn::Add(steady, hn::Sqrt(square))));
      centroid = hn::IfThenElse(hn::Gt(depth, Set(4)), hn::Min(centroid, at), centroid);
    }
    return {opacity, hn::IfThenElse(hn::Gt(opacity, hn::Zero(DF())), centroid, Set(0.5f))};
  }

  /// Returns the variance within halves: that of even light where they are thin.
  static HWY_INLINE VF WithinHalves(VF depth) {
    return hn::Mul(Set(1.0f / 48), hn::Max(hn::Sub(Set(1), hn::Mul(Set(1.0f / 12), depth)), Set(0)));
  }

  /// Returns a bound on the error of the light's mean position, as a share of the part's length. It bounds
  /// errors measured for opacities of 0 to 1 - 2^-20 at either end and depths up to 40.
  static HWY_INLINE VF BiasOf(const Extinction& a, const Extinction& b, VF mean, VF depth) {
    const VF ends = hn::Add(a.extinction, b.extinction), twice = hn::Add(mean, mean);
    const VF bent = hn::Div(hn::Abs(hn::Sub(ends, twice)), NotZero(hn::Add(ends, twice)));
    return hn::Min(Set(0.08f), hn::Add(hn::Mul(Set(0.004f), depth), hn::Mul(Set(0.05f), bent)));
  }

  /// Returns the opacity that gradient factors may add or remove between the sampled positions. Causes:
  /// points of the factor's curve, curvature of |g|, and the product of both changes.
  HWY_INLINE VF MissedFactors(const RayInCell& r, const Part& p, const Place (&at)[3], VF halfUnits) const {
    const TransferFunction& curve = *material_.f.transfer;
    const VF half = Set(0.5f), length = hn::Mul(half, hn::Sub(p.b, p.a)), zero = hn::Zero(DF());
    // A curve leaves its chord by at most an eighth of its second derivative times its length squared.
    const VF bend = hn::Max(Length(InFactorUnits(r.gradient.SecondAt(p.a))),
                            Length(InFactorUnits(r.gradient.SecondAt(p.b))));
    const VF leaves = hn::Mul(Set(0.125f), hn::Mul(bend, hn::Mul(length, length)));
    VF missed = zero;
    for (int n = 0; n < 2; ++n) {
      const Place &a = at[n], &b = at[n + 1];
      const VF lengthA = Length(a.gradient), lengthB = Length(b.gradient);
      const Nearest nearest = NearestOnChord(a.gradient, b.gradient);
      const VF sag = hn::Sub(Between(lengthA, lengthB, nearest.at), nearest.length);
      const VF beyond = Set(2);  // The factor is constant beyond this.
      const VF most = hn::Min(hn::Add(hn::Max(lengthA, lengthB), leaves), beyond);
      const VF least = hn::Min(hn::Max(hn::Sub(nearest.length, leaves), zero), beyond);
      const VF range = NotZero(hn::Sub(most, least));
      const VF change = hn::Abs(hn::Sub(a.factor, b.factor));
      const VF unit = Set(material_.f.factorUnit);
      const VF kinks = FactorBend(curve, hn::Mul(least, unit), hn::Mul(most, unit));
      const VF share = Clamp01(hn::Div(hn::Add(sag, leaves), range));  // Rounding may make sag negative.
      const VF bent = hn::Mul(share, hn::Add(change, kinks));
      const VF product = hn::Mul(Set(1.0f / 6), hn::Mul(change, hn::Abs(hn::Sub(a.opacity, b.opacity))));
      const VF opacity = hn::Max(a.opacity, b.opacity);
      missed = hn::Add(missed, hn::Add(hn::Mul(hn::Mul(half, opacity), hn::Add(kinks, bent)), product));
    }
    // Uses -ln(1 - f opacity) <= -f ln(1 - opacity).
    const VF opacity = hn::Max(at[0].opacity, at[2].opacity);
    const VF perOpacity = hn::Div(hn::Neg(TransparencyOf(opacity).log), NotZero(opacity));
    return OpacityOfDepth(hn::Mul(halfUnits, hn::Mul(perOpacity, missed)));
  }

  /// Returns a stored gradient in factorUnits, limited so that its square is finite.
  HWY_INLINE V3 InFactorUnits(const V3& stored) const {
    const V3 g = Scale(InPatient(material_.f, stored), Set(material_.f.factorUnitsAStored));
    const auto limited = [](VF x) { return hn::Min(hn::Max(x, Set(-1e15f)), Set(1e15f)); };
    return {limited(g.x), limited(g.y), limited(g.z)};
  }

  /// Position between two vectors (0..1) where the length is least, and that length.
  struct Nearest {
    VF at, length;
  };
  static HWY_INLINE Nearest NearestOnChord(const V3& a, const V3& b) {
    const V3 chord = Add(b, Scale(a, Set(-1)));
    const VF at = Clamp01(hn::Div(hn::Neg(Dot(a, chord)), NotZero(Dot(chord, chord))));
    return {at, Length(Add(a, Scale(chord, at)))};
  }

  const Material& material_;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
