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

/// Integrates parts by an embedded pair of rules. Opacity: between two places it is taken to rise straight,
/// and the extinction integrated in closed form (pre-integration; Engel, Kraus and Ertl 2001), over the whole
/// part and over its halves; a third of what they differ by is what the halves are off by, and is added
/// (Richardson's extrapolation). Colour: that of the place where the light comes from in the mean, and a
/// parabola through that and both ends, integrated with the light's mean and variance.
template <class Material>
class PartRule {
  static constexpr float kOffOfBent = 0.4f;  ///< what the parabola may be off by, as a share of what it adds

 public:
  explicit PartRule(const Material& matter) : matter_(matter) {}

  HWY_INLINE Lit ColourAt(const RayInCell& r, const CurveSegment& segment, VF s) const {
    V3 gradient = Zero3();
    if constexpr (Material::kLit) gradient = r.gradient.At(s);
    return matter_.LitColour(ColourOn(segment, DensityOn(r, segment, s)), gradient, r.ray);
  }

  /// `front` and `back`: the colours at its ends.
  HWY_INLINE PartSum Integrate(const RayInCell& r, const Part& p, const Lit& front, const Lit& back) const {
    const VF half = Set(0.5f), one = Set(1);
    const VF middle = hn::Mul(half, hn::Add(p.a, p.b));
    const Place places[3] = {PlaceAt(r, p, p.a), PlaceAt(r, p, middle), PlaceAt(r, p, p.b)};
    const Extinction &a = places[0].extinction, &m = places[1].extinction, &b = places[2].extinction;
    const VF units = hn::Mul(hn::Mul(r.units, half), hn::Sub(p.b, p.a)), halfUnits = hn::Mul(units, half);
    const VF mean = MeanOf(a, b), depth = hn::Mul(units, mean);
    const Slab first = SlabOf(a, m, halfUnits), second = SlabOf(m, b, halfUnits);
    const VF behind = hn::Mul(hn::Sub(one, first.opacity), second.opacity);
    const VF opacity = hn::Add(first.opacity, behind);
    const VF third = hn::Mul(hn::Sub(opacity, OpacityOfDepth(depth)), Set(1.0f / 3));
    PartSum sum{Zero3(), Clamp01(hn::Add(opacity, third)), hn::Abs(third)};
    if constexpr (Material::kFactors) sum.error = hn::Add(sum.error, MissedFactors(r, p, places, halfUnits));
    const VF per = hn::Div(one, NotZero(opacity));
    const VF at1 = hn::Mul(half, first.centroid), at2 = hn::Mul(half, hn::Add(one, second.centroid));
    const VF at = hn::Mul(hn::Add(hn::Mul(first.opacity, at1), hn::Mul(behind, at2)), per);
    const VF d1 = hn::Sub(at1, at), d2 = hn::Sub(at2, at);
    const VF between =
        hn::Mul(hn::Add(hn::Mul(first.opacity, hn::Mul(d1, d1)), hn::Mul(behind, hn::Mul(d2, d2))), per);
    AddColours(r, p, {at, hn::Add(between, WithinHalves(depth)), BiasOf(a, b, mean, depth)}, front, back,
               sum);
    return sum;
  }

 private:
  /// 1 - opacity and -ln of it, a unit distance each.
  struct Extinction {
    VF transparency, extinction;
  };
  /// `factor`, `gradient`: where opacity depends on gradients; value per mm.
  struct Place {
    Extinction extinction;
    VF opacity, factor;  ///< opacity: of the curve alone
    V3 gradient;
  };
  /// What lies between two places: its opacity; where its light comes from in the mean, 0..1.
  struct Slab {
    VF opacity, centroid;
  };
  /// Where the light of a part comes from, 0..1 of its length: mean and variance, and how far the mean may be
  /// off.
  struct Spread {
    VF mean, variance, bias;
  };

  static HWY_INLINE VF Between(VF a, VF b, VF share) { return hn::Add(a, hn::Mul(share, hn::Sub(b, a))); }

  static HWY_INLINE VF DensityOn(const RayInCell& r, const CurveSegment& segment, VF s) {
    return hn::Min(hn::Max(r.density.At(s), segment.low), segment.high);
  }
  HWY_INLINE Place PlaceAt(const RayInCell& r, const Part& p, VF s) const {
    Place place;
    place.opacity = OpacityOn(p.segment, DensityOn(r, p.segment, s));
    VF opacity = place.opacity;
    if constexpr (Material::kFactors) {
      place.gradient = InMm(r.gradient.At(s));
      place.factor = GradientFactor(*matter_.f.transfer, Length(place.gradient));
      opacity = hn::Mul(opacity, place.factor);
    }
    const Transparency t = TransparencyOf(opacity);
    place.extinction = {t.left, hn::Neg(t.log)};
    return place;
  }

  HWY_INLINE void AddColours(const RayInCell& r, const Part& p, const Spread& light, const Lit& front,
                             const Lit& back, PartSum& sum) const {
    const VF one = Set(1), opacity = sum.opacity;
    const Lit middle = ColourAt(r, p.segment, Between(p.a, p.b, light.mean));
    // Divided differences; light that comes from one end has next to no variance.
    const VF toFront = hn::Div(one, hn::Max(light.mean, Set(0.01f))),
             toBack = hn::Div(one, hn::Max(hn::Sub(one, light.mean), Set(0.01f)));
    VF off = hn::Zero(DF());
    if constexpr (Material::kLit) off = MissedLight(front, middle, back);
    const auto component = [&](VF c, VF c0, VF c1) {
      const VF rise0 = hn::Mul(hn::Sub(c, c0), toFront), rise1 = hn::Mul(hn::Sub(c1, c), toBack);
      const VF bent = hn::Mul(hn::Sub(rise1, rise0), light.variance);
      const VF biased = hn::Mul(light.bias, hn::Max(hn::Abs(rise0), hn::Abs(rise1)));
      off = hn::Max(off, hn::Add(hn::Mul(Set(kOffOfBent), hn::Abs(bent)), biased));
      return hn::Mul(opacity, hn::Max(hn::Add(c, bent), hn::Zero(DF())));
    };
    sum.colour.x = component(middle.colour.x, front.colour.x, back.colour.x);
    sum.colour.y = component(middle.colour.y, front.colour.y, back.colour.y);
    sum.colour.z = component(middle.colour.z, front.colour.z, back.colour.z);
    const VF brightest = hn::Max(Set(1), hn::Max(middle.colour.x, hn::Max(middle.colour.y, middle.colour.z)));
    sum.error = hn::Add(hn::Mul(sum.error, brightest), hn::Mul(opacity, off));
  }

  /// The light that may have come and gone between three places: by how far the normal turns on the way, and
  /// whether it passes a kink of the light there.
  HWY_INLINE VF MissedLight(const Lit& a, const Lit& m, const Lit& b) const {
    return hn::Max(MissedBetween(a, m), MissedBetween(m, b));
  }
  HWY_INLINE VF MissedBetween(const Lit& a, const Lit& b) const {
    const LightStrength& light = matter_.f.lightStrength;
    const V3 change = Add(a.normal, Scale(b.normal, Set(-1)));
    const VF square = Dot(change, change), turn = hn::Sqrt(square);
    // A highlight is so wide that a turn of 1 / sqrt(shininess) may step over a part of it.
    const VF over = hn::Mul(square, Set(0.5f * light.shininess));
    const VF shine = hn::Div(hn::Min(hn::Mul(over, over), Set(1)), hn::Sqrt(hn::Max(over, Set(1))));
    const VF smooth =
        hn::Add(hn::Mul(Set(0.05f * light.diffuse), square), hn::Mul(Set(0.25f * light.specular), shine));
    // Between the two sides that a viewer may see, and where highlights begin, light changes within a tenth
    // of a turn from nothing to all of it.
    const VI sides = hn::Xor(a.sides, b.sides);
    const auto passes = [&](VI bits) { return hn::RebindMask(DF(), hn::Ne(bits, SetI(0))); };
    const VF sudden = hn::Mul(Set(0.25f), hn::Min(hn::Mul(Set(5), turn), Set(1)));
    const VF ofLights =
        hn::Add(hn::Mul(Set(0.125f * light.diffuse), turn), hn::Mul(Set(light.specular), sudden));
    const VF ofSides = hn::Mul(Set(light.diffuse + light.specular), sudden);
    const VF kinks =
        hn::IfThenElse(passes(hn::And(sides, SetI(3))), ofSides, hn::IfThenElseZero(passes(sides), ofLights));
    return hn::Add(smooth, kinks);
  }

  static HWY_INLINE VF MeanOf(const Extinction& a, const Extinction& b) {
    return MeanOnSegment(a.transparency, a.extinction, b.transparency, b.extinction);
  }

  /// The centroid is that of Simpson's rule over the transmittance T: (integral of T - T at the back) /
  /// opacity, with the depth of the front half as if the extinction rose straight.
  static HWY_INLINE Slab SlabOf(const Extinction& a, const Extinction& b, VF units) {
    const VF e1 = a.extinction, sum = hn::Add(e1, b.extinction);
    const VF depth = hn::Mul(units, MeanOf(a, b)), opacity = OpacityOfDepth(depth);
    const VF share = hn::Div(hn::Add(hn::Add(e1, e1), sum), NotZero(hn::Mul(Set(4), sum)));
    const VF hidden = hn::Div(OpacityOfDepth(hn::Mul(depth, share)), NotZero(opacity));
    const VF centroid = hn::Sub(Set(5.0f / 6), hn::Mul(Set(2.0f / 3), hidden));
    return {opacity, hn::IfThenElse(hn::Gt(opacity, hn::Zero(DF())), centroid, Set(0.5f))};
  }

  /// The variance within halves: that of even light where they are thin.
  static HWY_INLINE VF WithinHalves(VF depth) {
    return hn::Mul(Set(1.0f / 48), hn::Max(hn::Sub(Set(1), hn::Mul(Set(1.0f / 12), depth)), Set(0)));
  }

  /// How far the mean of a part's light may be off, as a share of its length: a bound on what was found for
  /// opacities of 0 to 1 - 2^-20 at either end and depths up to 40.
  static HWY_INLINE VF BiasOf(const Extinction& a, const Extinction& b, VF mean, VF depth) {
    const VF ends = hn::Add(a.extinction, b.extinction), twice = hn::Add(mean, mean);
    const VF bent = hn::Div(hn::Abs(hn::Sub(ends, twice)), NotZero(hn::Add(ends, twice)));
    return hn::Min(Set(0.08f), hn::Add(hn::Mul(Set(0.004f), depth), hn::Mul(Set(0.05f), bent)));
  }

  /// The opacity that factors over the gradient may add or take between the places where they were looked at:
  /// where the factor has points, where |g| is not straight, and by the product of what changes.
  HWY_INLINE VF MissedFactors(const RayInCell& r, const Part& p, const Place (&at)[3], VF halfUnits) const {
    const TransferFunction& curve = *matter_.f.transfer;
    const VF half = Set(0.5f), length = hn::Mul(half, hn::Sub(p.b, p.a)), zero = hn::Zero(DF());
    // A curve leaves its chord by no more than an eighth of its second derivative times the square of its
    // length.
    const VF bend = hn::Max(Length(InMm(r.gradient.SecondAt(p.a))), Length(InMm(r.gradient.SecondAt(p.b))));
    const VF leaves = hn::Mul(Set(0.125f), hn::Mul(bend, hn::Mul(length, length)));
    VF missed = zero;
    for (int n = 0; n < 2; ++n) {
      const Place &a = at[n], &b = at[n + 1];
      const VF lengthA = Length(a.gradient), lengthB = Length(b.gradient);
      const Nearest nearest = NearestOnChord(a.gradient, b.gradient);
      const VF sag = hn::Sub(Between(lengthA, lengthB, nearest.at), nearest.length);
      const VF most = hn::Add(hn::Max(lengthA, lengthB), leaves);
      const VF least = hn::Max(hn::Sub(nearest.length, leaves), zero);
      const VF range = NotZero(hn::Sub(most, least));
      const VF change = hn::Abs(hn::Sub(a.factor, b.factor));
      const VF kinks = FactorBend(curve, least, most);
      const VF bent = hn::Mul(hn::Div(hn::Add(sag, leaves), range), hn::Add(change, kinks));
      const VF product = hn::Mul(Set(1.0f / 6), hn::Mul(change, hn::Abs(hn::Sub(a.opacity, b.opacity))));
      const VF opacity = hn::Max(a.opacity, b.opacity);
      missed = hn::Add(missed, hn::Add(hn::Mul(hn::Mul(half, opacity), hn::Add(kinks, bent)), product));
    }
    // -ln(1 - f opacity) <= -f ln(1 - opacity).
    const VF opacity = hn::Max(at[0].opacity, at[2].opacity);
    const VF perOpacity = hn::Div(hn::Neg(TransparencyOf(opacity).log), NotZero(opacity));
    return OpacityOfDepth(hn::Mul(halfUnits, hn::Mul(perOpacity, missed)));
  }

  /// A stored gradient in value per mm.
  HWY_INLINE V3 InMm(const V3& stored) const {
    return Scale(InPatient(matter_.f, stored), Set(matter_.f.gradientUnit));
  }

  /// Where between two vectors (0..1) the length is least, and that length.
  struct Nearest {
    VF at, length;
  };
  static HWY_INLINE Nearest NearestOnChord(const V3& a, const V3& b) {
    const V3 chord = Add(b, Scale(a, Set(-1)));
    const VF at = Clamp01(hn::Div(hn::Neg(Dot(a, chord)), NotZero(Dot(chord, chord))));
    return {at, Length(Add(a, Scale(chord, at)))};
  }

  const Material& matter_;
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
