// Classification and lighting of samples. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_SHADE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_SHADE_INL_H_
#undef VOLUMEN_KERNELS_SHADE_INL_H_
#else
#define VOLUMEN_KERNELS_SHADE_INL_H_
#endif

#include <cmath>
#include <limits>

#include "viewer/kernels/math-inl.h"
#include "viewer/kernels/trace.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Returns entries of one of a curve's arrays: by a permutation if all segments fit into one vector, else by
/// a gather.
HWY_INLINE VF OfSegment(const CurveTable& t, const std::vector<float>& values, VI segment) {
  const DF df;
  static_assert(CurveTable::padding * sizeof(float) >= HWY_MAX_BYTES);
  if (t.segments <= int(hn::Lanes(df)))
    return hn::TableLookupLanes(hn::LoadU(df, values.data()), hn::IndicesFromVec(df, segment));
  return hn::GatherIndex(df, values.data(), segment);
}

/// Returns the segment of the curve of each density (CurveTable): the number of nodes at or below it.
HWY_INLINE VI SegmentOf(const CurveTable& t, VF density) {
  const DF df;
  const DI di;
  const auto plusOneWhere = [&](MF m, VI v) {
#if HWY_TARGET <= HWY_AVX3
    return hn::IfThenElse(hn::RebindMask(di, m), hn::Add(v, SetI(1)), v);
#else
    // A mask is -1 in every lane where it holds.
    return hn::Sub(v, hn::BitCast(di, hn::VecFromMask(df, m)));
#endif
  };
  constexpr int few = 8;
  if (t.segments <= few) {
    VI segment = hn::Zero(di);
    for (int n = 0; n + 1 < t.segments; ++n) segment = plusOneWhere(hn::Ge(density, Set(t.node[n])), segment);
    return segment;
  }
  if (t.segments <= int(hn::Lanes(df))) {
    // Binary search: permutations take less time than one gather.
    VI segment = hn::Zero(di);
    for (int step = int(hn::Lanes(df)) / 2; step > 0; step /= 2) {
      const VF node = OfSegment(t, t.node, hn::Add(segment, SetI(step - 1)));
      const VI farther = hn::Add(segment, SetI(step));
      segment = hn::IfThenElse(hn::RebindMask(di, hn::Ge(density, node)), farther, segment);
    }
    return segment;
  }
  const VF bucket = hn::Mul(hn::Sub(density, Set(t.low)), Set(t.perBucket));
  const VI b = Truncated(hn::Min(hn::Max(bucket, hn::Zero(df)), Set(float(CurveTable::buckets - 1))));
  VI segment = hn::GatherIndex(di, t.first.data(), b);
  for (int hop = 0; hop < t.hops; ++hop)
    segment = plusOneWhere(hn::Ge(density, OfSegment(t, t.node, segment)), segment);
  return segment;
}

HWY_INLINE VF OnSegment(const CurveTable& t, const std::vector<float>& at, const std::vector<float>& rise,
                        VI segment, VF along) {
  return hn::Add(OfSegment(t, at, segment), hn::Mul(along, OfSegment(t, rise, segment)));
}

HWY_INLINE VF Along(const CurveTable& t, VI segment, VF density) {
  return hn::Sub(density, OfSegment(t, t.start, segment));
}

HWY_INLINE VF OpacityOf(const CurveTable& t, VI segment, VF density) {
  return Clamp01(OnSegment(t, t.opacity, t.opacityRise, segment, Along(t, segment, density)));
}

HWY_INLINE V3 ColourOf(const CurveTable& t, VI segment, VF density) {
  const VF along = Along(t, segment, density);
  return {Clamp01(OnSegment(t, t.red, t.redRise, segment, along)),
          Clamp01(OnSegment(t, t.green, t.greenRise, segment, along)),
          Clamp01(OnSegment(t, t.blue, t.blueRise, segment, along))};
}

/// A segment of the curve, linear between two densities.
struct CurveSegment {
  VF low, high;
  VF start, opacity, opacityRise;  ///< Opacity at `start`, and its rise per unit of density.
  V3 colour, colourRise;
};

/// Returns the density at which a segment begins.
HWY_INLINE VF LowOf(const CurveTable& t, VI segment) {
  const MF isFirst = hn::RebindMask(DF(), hn::Eq(segment, hn::Zero(DI())));
  const VF before = OfSegment(t, t.node, hn::Max(hn::Sub(segment, SetI(1)), hn::Zero(DI())));
  return hn::IfThenElse(isFirst, Set(-std::numeric_limits<float>::infinity()), before);
}

HWY_INLINE CurveSegment SegmentAt(const CurveTable& t, VI segment) {
  const auto of = [&](const std::vector<float>& values) { return OfSegment(t, values, segment); };
  return {LowOf(t, segment),
          of(t.node),
          of(t.start),
          of(t.opacity),
          of(t.opacityRise),
          {of(t.red), of(t.green), of(t.blue)},
          {of(t.redRise), of(t.greenRise), of(t.blueRise)}};
}

HWY_INLINE VF OpacityOn(const CurveSegment& s, VF density) {
  return Clamp01(hn::Add(s.opacity, hn::Mul(hn::Sub(density, s.start), s.opacityRise)));
}
HWY_INLINE V3 ColourOn(const CurveSegment& s, VF density) {
  const V3 c = Add(s.colour, Scale(s.colourRise, hn::Sub(density, s.start)));
  return {Clamp01(c.x), Clamp01(c.y), Clamp01(c.z)};
}

/// Returns the segment with its densities counted from `base`.
HWY_INLINE CurveSegment CountedFrom(VF base, CurveSegment s) {
  for (VF* density : {&s.low, &s.high, &s.start}) *density = hn::Sub(*density, base);
  return s;
}

/// Returns the factor of gradientOpacity (picture.md 4) at |g_p|. There are few points, so they are searched
/// in turn.
HWY_INLINE VF GradientFactor(const TransferFunction& curve, VF length) {
  const auto& points = curve.gradientOpacity;
  if (points.empty()) return Set(1);
  VF factor = Set(float(points.front().factor));
  for (std::size_t n = 0; n + 1 < points.size(); ++n) {
    const float low = float(points[n].gradient), width = float(points[n + 1].gradient - points[n].gradient);
    const VF place = width > 0 ? Clamp01(hn::Mul(hn::Sub(length, Set(low)), Set(1 / width))) : Set(1);
    const VF here = Lerp(Set(float(points[n].factor)), Set(float(points[n + 1].factor)), place);
    factor = hn::IfThenElse(hn::Ge(length, Set(low)), here, factor);
  }
  return hn::IfThenElse(hn::Ge(length, Set(float(points.back().gradient))), Set(float(points.back().factor)),
                        factor);
}

/// Returns the largest deviation of the factor from the straight line between two gradient lengths.
HWY_INLINE VF FactorBend(const TransferFunction& curve, VF least, VF most) {
  const VF first = GradientFactor(curve, least), change = hn::Sub(GradientFactor(curve, most), first);
  const VF rise = hn::Div(change, NotZero(hn::Sub(most, least)));
  VF bend = hn::Zero(DF());
  for (const auto& point : curve.gradientOpacity) {
    const VF at = Set(float(point.gradient));
    const VF straight = hn::Add(first, hn::Mul(rise, hn::Sub(at, least)));
    const MF inside = hn::And(hn::Gt(at, least), hn::Le(at, most));
    bend = hn::Max(bend, hn::IfThenElseZero(inside, hn::Abs(hn::Sub(Set(float(point.factor)), straight))));
  }
  return bend;
}

/// Returns a stored gradient in patient space, in gradientUnits per mm.
HWY_INLINE V3 InPatient(const RayInputs& f, const V3& stored) {
  const float* m = f.gradientMatrix;
  return {Dot({Set(m[0]), Set(m[1]), Set(m[2])}, stored), Dot({Set(m[3]), Set(m[4]), Set(m[5])}, stored),
          Dot({Set(m[6]), Set(m[7]), Set(m[8])}, stored)};
}

/// |g_p| and the normal -g_p / |g_p| of a stored gradient (picture.md 3, 5).
struct Normal {
  V3 n;
  VF length;
};
HWY_INLINE Normal NormalOf(const RayInputs& f, const V3& stored) {
  const V3 g = InPatient(f, stored);
  if (f.boundedGradients) {
    const VF square = hn::Max(Dot(g, g), Set(1e-30f));
    const VF inverse = hn::Div(Set(1), hn::Sqrt(square));
    return {Scale(g, hn::Neg(inverse)), hn::Mul(hn::Mul(square, inverse), Set(f.gradientUnit))};
  }
  // Divides by the largest component first, so that large and small gradients stay within the range of
  // floats.
  const VF largest = hn::Max(hn::Max(hn::Abs(g.x), hn::Abs(g.y)), hn::Max(hn::Abs(g.z), Set(1e-30f)));
  const V3 unit = Scale(g, hn::Div(Set(1), largest));
  const VF size = hn::Sqrt(hn::Max(Dot(unit, unit), Set(1e-30f)));
  return {Scale(unit, hn::Div(Set(-1), size)), hn::Mul(hn::Mul(largest, size), Set(f.gradientUnit))};
}

struct DS {
  V3 d, s;
};
HWY_INLINE DS InGrey(VF d, VF s) { return {{d, d, d}, {s, s, s}}; }

/// Returns D'(n) and S'(n) of picture.md 5. A light shines on one side of a surface only. Each light is thus
/// evaluated once and weighted by how much the viewer sees of that side. The vector h of light i is the
/// light's own, or with `kLocal` that of the sample's viewer.
template <bool kLocal>
HWY_INLINE DS ShadePhong(const Lighting& lighting, const V3& n, const V3& viewer) {
  const VF zero = hn::Zero(DF()), one = Set(1), shininess = Set(lighting.shininess);
  const VF front = lighting.twoSided ? Clamp01(hn::Add(Set(0.5f), hn::Mul(Dot(n, viewer), Set(5)))) : one;
  const VF back = hn::Sub(one, front);
  DS out = InGrey(Set(lighting.ambient), zero);
  const auto add = [&](V3& sum, const glm::vec3& strength, VF share) {
    sum.x = hn::Add(sum.x, hn::Mul(Set(strength.r), share));
    if (!lighting.coloured) return;
    sum.y = hn::Add(sum.y, hn::Mul(Set(strength.g), share));
    sum.z = hn::Add(sum.z, hn::Mul(Set(strength.b), share));
  };
  for (const ShadingLight& light : lighting.lights) {
    const V3 l = Broadcast(light.l);
    const VF nl = Dot(n, l), toLight = hn::Abs(nl);
    const MF isFront = hn::Ge(nl, zero);
    const VF side = hn::IfThenElse(isFront, front, back);
    add(out.d, light.diffuse, hn::Mul(toLight, side));
    if (!lighting.specular) continue;
    V3 h = Broadcast(light.h);
    if constexpr (kLocal) {
      const V3 both = Add(l, viewer);
      const VF length = hn::Sqrt(Dot(both, both));
      h = Scale(both,
                hn::IfThenElseZero(hn::Ge(length, Set(1e-3f)), hn::Div(one, hn::Max(length, Set(1e-3f)))));
    }
    const VF alongN = Dot(n, h), along = hn::Min(hn::IfThenElse(isFront, alongN, hn::Neg(alongN)), one);
    const VF power =
        lighting.wholeShininess ? WholePower(along, lighting.wholeShininess) : Power(along, shininess);
    const VF facing = hn::Min(hn::Mul(toLight, Set(10)), one);
    add(out.s, light.specular,
        hn::IfThenElseZero(hn::Gt(along, zero), hn::Mul(hn::Mul(facing, side), power)));
  }
  return lighting.coloured ? out : InGrey(out.d.x, out.s.x);
}

/// Returns which kinks of D' and S' a normal lies between, as bits. Bits 0 and 1: the side of a surface that
/// the viewer sees; neither if both. Two bits per light follow: whether it shines on the front, and whether
/// its highlight counts in full. Lights that are 15 apart share their bits.
HWY_INLINE VI SidesOf(const Lighting& lighting, const V3& n, const V3& viewer) {
  const DI di;
  VI sides = SetI(0);
  const auto add = [&](MF which, int bit) {
    sides = hn::Xor(sides, hn::IfThenElseZero(hn::RebindMask(di, which), SetI(int(1u << bit))));
  };
  if (lighting.twoSided) {
    const VF along = Dot(n, viewer), band = Set(0.1f);
    add(hn::Gt(along, band), 0);
    add(hn::Lt(along, hn::Neg(band)), 1);
  }
  int bit = 0;
  for (const ShadingLight& light : lighting.lights) {
    const VF along = Dot(n, Broadcast(light.l));
    add(hn::Gt(along, hn::Zero(DF())), 2 + bit);
    const glm::vec3& s = light.specular;
    if (s.r > 0 || s.g > 0 || s.b > 0) add(hn::Gt(hn::Abs(along), Set(0.1f)), 3 + bit);
    bit = (bit + 2) % 30;
  }
  return sides;
}

/// Points where directions meet the cube of a reflectance map: face, and u, v in -1 .. 1.
struct CubePlace {
  VI face;
  VF u, v;
};
HWY_INLINE CubePlace OnCube(const V3& n) {
  const DF df;
  const VF ax = hn::Abs(n.x), ay = hn::Abs(n.y), az = hn::Abs(n.z);
  const MF isX = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az)), isY = hn::AndNot(isX, hn::Ge(ay, az));
  const auto choose = [&](VF x, VF y, VF z) { return hn::IfThenElse(isX, x, hn::IfThenElse(isY, y, z)); };
  const VF major = choose(n.x, n.y, n.z);
  const VF inverse = hn::Div(Set(1), hn::IfThenElse(hn::Eq(major, hn::Zero(df)), Set(1), major));
  const VI axisFace = Truncated(choose(hn::Zero(df), Set(2), Set(4)));
  const VI face = hn::Add(axisFace, Truncated(hn::IfThenElseZero(hn::Lt(major, hn::Zero(df)), Set(1))));
  return {face, hn::Mul(choose(n.y, n.z, n.x), inverse), hn::Mul(choose(n.z, n.x, n.y), inverse)};
}

/// Returns the index of a node's first float.
HWY_INLINE VI FirstFloat(const ReflectanceMap& map, VI node) {
  static_assert(ReflectanceMap::floatsANode(true) == 8 && ReflectanceMap::floatsANode(false) == 2);
  return map.coloured ? hn::ShiftLeft<3>(node) : hn::ShiftLeft<1>(node);
}

/// Interpolates bilinearly between four nodes of a map, the first of which begins at float `at`.
HWY_INLINE DS BetweenNodes(const ReflectanceMap& map, VI at, VF fu, VF fv) {
  HWY_ALIGN std::int32_t from[hn::MaxLanes(DI())];
  hn::Store(at, DI(), from);
  const float* nodes = map.nodes.data();
  const std::ptrdiff_t floats = ReflectanceMap::floatsANode(map.coloured), nextRow = map.n * floats;
  if (!map.coloured) {
    const FourEach low = LoadFourEach(nodes, from), high = LoadFourEach(nodes + nextRow, from);
    const auto between = [&](VF a, VF b, VF c, VF d) { return Lerp(Lerp(a, b, fu), Lerp(c, d, fu), fv); };
    return InGrey(between(low.a, low.c, high.a, high.c), between(low.b, low.d, high.b, high.d));
  }
  const auto half = [&](int first) {
    const auto row = [&](const float* p) {
      const FourEach x = LoadFourEach(p, from), next = LoadFourEach(p + floats, from);
      return FourEach{Lerp(x.a, next.a, fu), Lerp(x.b, next.b, fu), Lerp(x.c, next.c, fu),
                      Lerp(x.d, next.d, fu)};
    };
    const FourEach low = row(nodes + first), high = row(nodes + nextRow + first);
    return FourEach{Lerp(low.a, high.a, fv), Lerp(low.b, high.b, fv), Lerp(low.c, high.c, fv),
                    Lerp(low.d, high.d, fv)};
  };
  const FourEach redAndGreen = half(0), blue = half(4);
  return {{redAndGreen.a, redAndGreen.c, blue.a}, {redAndGreen.b, redAndGreen.d, blue.b}};
}

/// Returns D' and S' from the reflectance map, bilinear on the face of the normal's largest component (paper
/// 2.2).
HWY_INLINE DS ShadeMap(const ReflectanceMap& map, const V3& n) {
  const DF df;
  const CubePlace place = OnCube(n);
  const VF half = Set(0.5f * float(map.n - 1)), limit = Set(float(map.n - 1));
  const auto toNodes = [&](VF c) {
    return hn::Min(hn::Max(hn::Mul(hn::Add(c, Set(1)), half), hn::Zero(df)), limit);
  };
  const VF u = toNodes(place.u), v = toNodes(place.v);
  const VI iu = hn::Min(Truncated(u), SetI(map.n - 2)), iv = hn::Min(Truncated(v), SetI(map.n - 2));
  const VF fu = hn::Sub(u, hn::ConvertTo(df, iu)), fv = hn::Sub(v, hn::ConvertTo(df, iv));
  const VI node = hn::Add(hn::Mul(hn::Add(hn::Mul(place.face, SetI(map.n)), iv), SetI(map.n)), iu);
  return BetweenNodes(map, FirstFloat(map, node), fu, fv);
}

/// Returns the weight q of a normal (picture.md 5) for |g_p|.
HWY_INLINE VF ShareOfNormal(const RayInputs& f, VF length) {
  return hn::Min(Set(1), hn::Mul(length, Set(f.inverseFloor)));
}

/// Returns D'' and S'' (picture.md 5): a gradient too small to have a direction is lit flatly.
HWY_INLINE DS WithFloor(const RayInputs& f, const DS& shade, VF q) {
  const glm::vec3& flat = f.lighting->flat;
  if (!f.lighting->coloured) return InGrey(Lerp(Set(flat.r), shade.d.x, q), hn::Mul(shade.s.x, q));
  return {{Lerp(Set(flat.r), shade.d.x, q), Lerp(Set(flat.g), shade.d.y, q), Lerp(Set(flat.b), shade.d.z, q)},
          Scale(shade.s, q)};
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
