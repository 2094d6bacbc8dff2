// Vector functions of the kernels. Compiled once per CPU target. No operation fuses a multiply and an add, so
// that every target gives the same bytes.
#if defined(VOLUMEN_KERNELS_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_MATH_INL_H_
#undef VOLUMEN_KERNELS_MATH_INL_H_
#else
#define VOLUMEN_KERNELS_MATH_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <glm/vec3.hpp>

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using DF = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<DF>;
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;
using MF = hn::Mask<DF>;

HWY_INLINE VF Set(float x) { return hn::Set(DF(), x); }
HWY_INLINE VI SetI(int x) { return hn::Set(DI(), x); }

struct V3 {
  VF x, y, z;
};
HWY_INLINE V3 Zero3() { return {hn::Zero(DF()), hn::Zero(DF()), hn::Zero(DF())}; }
HWY_INLINE VF Dot(const V3& a, const V3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE V3 Scale(const V3& a, VF s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }
HWY_INLINE V3 Add(const V3& a, const V3& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V3 IfThenElse3(MF m, const V3& a, const V3& b) {
  return {hn::IfThenElse(m, a.x, b.x), hn::IfThenElse(m, a.y, b.y), hn::IfThenElse(m, a.z, b.z)};
}
/// Loads the positions from index n on from arrays that are aligned for vectors.
template <class Array>
HWY_INLINE V3 PlaceOf(const Array& s, int n) {
  const DF df;
  return {hn::Load(df, s.x + n), hn::Load(df, s.y + n), hn::Load(df, s.z + n)};
}
HWY_INLINE V3 Broadcast(const glm::vec3& v) { return {Set(v.x), Set(v.y), Set(v.z)}; }
/// Returns a + f (b - a), which is exactly a where a = b (picture.md 2).
HWY_INLINE VF Lerp(VF a, VF b, VF f) { return hn::Add(a, hn::Mul(f, hn::Sub(b, a))); }
/// Loads one lane's bytes from base[index[lane]]. With `kLanes` > 1 each load fills that many lanes and uses
/// every kLanes-th index. Plain loads are used: a gather takes twice as long where memory is slow, and about
/// as long in cache.
template <int kLanes = 1, class D, class T>
HWY_INLINE hn::Vec<D> LoadEach(D d, const T* base, const std::int32_t* index) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(d) > kLanes) {
    const hn::Half<D> half;
    return hn::Combine(d, LoadEach<kLanes>(half, base, index + hn::MaxLanes(d) / 2),
                       LoadEach<kLanes>(half, base, index));
  }
#endif
  return hn::LoadU(d, reinterpret_cast<const hn::TFromD<D>*>(base + index[0]));
}
/// LoadEach from four bases, a few lanes of all four at a time. Compilers run out of registers for the
/// indices of a whole vector.
template <class D, class T>
HWY_INLINE void LoadEachOfFour(D d, const std::array<const T*, 4>& base, const std::int32_t* index,
                               hn::Vec<D> (&out)[4]) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(d) > 4) {
    const hn::Half<D> half;
    hn::Vec<hn::Half<D>> low[4], high[4];
    LoadEachOfFour(half, base, index, low);
    LoadEachOfFour(half, base, index + hn::MaxLanes(half), high);
    for (int n = 0; n < 4; ++n) out[n] = hn::Combine(d, high[n], low[n]);
    return;
  }
#endif
  for (int n = 0; n < 4; ++n) out[n] = LoadEach(d, base[n], index);
}

/// The four floats from base[index[lane]] on, for each lane.
struct FourEach {
  VF a, b, c, d;
};
template <class T>
HWY_INLINE FourEach LoadFourEach(const T* base, const std::int32_t* index) {
#if HWY_TARGET == HWY_SCALAR
  const auto* p = reinterpret_cast<const float*>(base + index[0]);
  return {VF(p[0]), VF(p[1]), VF(p[2]), VF(p[3])};
#else
  const DF df;
  const VF of0 = LoadEach<4>(df, base, index), of1 = LoadEach<4>(df, base, index + 1),
           of2 = LoadEach<4>(df, base, index + 2), of3 = LoadEach<4>(df, base, index + 3);
  const VF ab02 = hn::InterleaveLower(df, of0, of2), ab13 = hn::InterleaveLower(df, of1, of3),
           cd02 = hn::InterleaveUpper(df, of0, of2), cd13 = hn::InterleaveUpper(df, of1, of3);
  return {hn::InterleaveLower(df, ab02, ab13), hn::InterleaveUpper(df, ab02, ab13),
          hn::InterleaveLower(df, cd02, cd13), hn::InterleaveUpper(df, cd02, cd13)};
#endif
}
/// Added to |x| <= 2^22, it leaves the nearest integer (ties to even) in the lowest bits. Its value is 1.5 *
/// 2^23.
constexpr float kRounding = 12582912.0f;
/// Truncates |x| < 2^31 towards 0. hn::ConvertTo also guards against larger values, at four times the cost.
HWY_INLINE VI Truncated(VF x) {
#if HWY_TARGET == HWY_SCALAR || !HWY_ARCH_X86
  return hn::ConvertTo(DI(), x);
#elif HWY_MAX_BYTES == 64
  return VI{_mm512_cvttps_epi32(x.raw)};
#elif HWY_MAX_BYTES == 32
  return VI{_mm256_cvttps_epi32(x.raw)};
#else
  return VI{_mm_cvttps_epi32(x.raw)};
#endif
}
/// Returns a safe divisor: x, or 1e-30 if x is 0.
HWY_INLINE VF NotZero(VF x) { return hn::IfThenElse(hn::Eq(x, hn::Zero(DF())), Set(1e-30f), x); }
HWY_INLINE VF Length(const V3& v) { return hn::Sqrt(Dot(v, v)); }
HWY_INLINE VF Clamp01(VF x) { return hn::Min(hn::Max(x, hn::Zero(DF())), Set(1)); }

/// Returns the natural logarithm of x in (0, 2); relative error about 1e-7. Polynomial: Cephes logf.
HWY_INLINE VF Log(VF x) {
  const DF df;
  const DI di;
  const VI bits = hn::BitCast(di, x);
  // x = m 2^e with m in [sqrt(1/2), sqrt(2)).
  const VI shifted = hn::Sub(bits, SetI(0x3f3504f3));
  const VI e = hn::ShiftRight<23>(shifted);
  const VF m = hn::BitCast(df, hn::Add(hn::And(shifted, SetI(0x007fffff)), SetI(0x3f3504f3)));
  const VF f = hn::Sub(m, Set(1)), f2 = hn::Mul(f, f);
  // Evaluates pairs of terms side by side. A chain of nineteen operations would take longer than the rest of
  // a sample.
  const auto pair = [&](float c0, float c1) { return hn::Add(Set(c0), hn::Mul(f, Set(c1))); };
  const VF f4 = hn::Mul(f2, f2);
  const VF low = hn::Add(pair(3.3333331174e-1f, -2.4999993993e-1f),
                         hn::Mul(f2, pair(2.0000714765e-1f, -1.6668057665e-1f)));
  const VF high = hn::Add(pair(1.4249322787e-1f, -1.2420140846e-1f),
                          hn::Mul(f2, pair(1.1676998740e-1f, -1.1514610310e-1f)));
  const VF p = hn::Add(hn::Add(low, hn::Mul(f4, high)), hn::Mul(hn::Mul(f4, f4), Set(7.0376836292e-2f)));
  const VF ef = hn::ConvertTo(df, e);
  VF y = hn::Mul(hn::Mul(p, f2), f);
  y = hn::Add(y, hn::Mul(ef, Set(-2.12194440e-4f)));
  y = hn::Sub(y, hn::Mul(f2, Set(0.5f)));
  return hn::Add(hn::Add(f, y), hn::Mul(ef, Set(0.693359375f)));
}

/// Returns exp(x) - 1 for x in [-87, 0]. The relative error is about 1e-7, also for small |x|. Polynomial:
/// Cephes expf.
HWY_INLINE VF ExpMinus1(VF x) {
  const DF df;
  const DI di;
  const VF rounded = hn::Add(hn::Mul(x, Set(1.44269504088896341f)), Set(kRounding));
  const VF n = hn::Sub(rounded, Set(kRounding));
  const VF r = hn::Sub(hn::Sub(x, hn::Mul(n, Set(0.693359375f))), hn::Mul(n, Set(-2.12194440e-4f)));
  const VF r2 = hn::Mul(r, r);
  const auto pair = [&](float c0, float c1) { return hn::Add(Set(c0), hn::Mul(r, Set(c1))); };
  const VF low = hn::Add(pair(5.0000001201e-1f, 1.6666665459e-1f),
                         hn::Mul(r2, pair(4.1665795894e-2f, 8.3334519073e-3f)));
  const VF p = hn::Add(low, hn::Mul(hn::Mul(r2, r2), pair(1.3981999507e-3f, 1.9875691500e-4f)));
  const VF small = hn::Add(hn::Mul(r2, p), r);
  // The lowest bits of kRounding are 0, and the bits above them are shifted out.
  const VF power = hn::BitCast(df, hn::ShiftLeft<23>(hn::Add(hn::BitCast(di, rounded), SetI(127))));
  return hn::Add(hn::Mul(power, small), hn::Sub(power, Set(1)));
}

/// Opacities above this are treated as this: 1 - 2^-20.
constexpr float kMostOpacity = 1.0f - 9.5367431640625e-7f;
constexpr float kLogOfOpaque = -13.862943611f;  ///< Equals TransparencyOf(kMostOpacity).log.

/// 1 - opacity, and its logarithm without loss of precision for small opacities.
struct Transparency {
  VF left, log;
};
HWY_INLINE Transparency TransparencyOf(VF opacity) {
  const VF one = Set(1);
  const VF o = hn::Min(opacity, Set(kMostOpacity));
  const VF left = hn::Sub(one, o);
  // Adds the rounding error of the subtraction, so that log1p(-o) keeps its relative accuracy. The exact term
  // is lost / left. Where left is far from 1, nothing is lost or log is far larger.
  const VF lost = hn::Sub(hn::Sub(one, left), o);
  return {left, hn::Add(Log(left), lost)};
}

/// Returns 1 - exp(-depth), the opacity of an optical depth >= 0.
HWY_INLINE VF OpacityOfDepth(VF depth) { return hn::Neg(ExpMinus1(hn::Max(hn::Neg(depth), Set(-80)))); }

/// Returns 1 - (1 - x)^n for 0 <= x < 1/16 and x n < 1/8 by the binomial series. Its seventh term is below
/// 1e-8 of the first.
HWY_INLINE VF FaintOpacity(VF x, VF n) {
  const VF one = Set(1);
  VF rest = one;
  for (int k = 5; k >= 1; --k) {
    const VF ratio = hn::Mul(hn::Sub(n, Set(float(k))), Set(1 / float(k + 1)));
    rest = hn::Sub(one, hn::Mul(hn::Mul(ratio, x), rest));
  }
  return hn::Mul(hn::Mul(n, x), rest);
}

/// Opacity correction (picture.md 4, 9): returns 1 - (1 - opacity)^unitDistances without loss where it is
/// small. `opacity` is per unit distance. `unitDistances` is the length of the interval in unit distances.
/// Lanes in `others` are ignored.
HWY_INLINE VF PowerOpacity(VF opacity, VF unitDistances, MF others) {
  // Curves with steps yield only faint or fully opaque samples, and the logarithm of the latter is known.
  const MF known = hn::Or(others, hn::Ge(opacity, Set(kMostOpacity)));
  const VF log = hn::AllTrue(DF(), known) ? Set(kLogOfOpaque) : TransparencyOf(opacity).log;
  return hn::Neg(ExpMinus1(hn::Max(hn::Mul(log, unitDistances), Set(-80))));
}

/// Returns the same as PowerOpacity() to within rounding, but faster if opacities are small.
HWY_INLINE VF CorrectedOpacity(VF opacity, VF unitDistances) {
  const MF faint =
      hn::And(hn::Lt(opacity, Set(1.0f / 16)), hn::Lt(hn::Mul(opacity, unitDistances), Set(1.0f / 8)));
  const VF series = FaintOpacity(opacity, unitDistances);
  if (hn::AllTrue(DF(), faint)) return series;
  return hn::IfThenElse(faint, series, PowerOpacity(opacity, unitDistances, faint));
}

/// Returns x^power for whole powers >= 1 by repeated multiplication.
HWY_INLINE VF WholePower(VF x, int power) {
  VF out = power & 1 ? x : Set(1);
  for (int left = power >> 1; left; left >>= 1) {
    x = hn::Mul(x, x);
    if (left & 1) out = hn::Mul(out, x);
  }
  return out;
}

/// Returns x^power for x in [0, 1] and power >= 1.
HWY_INLINE VF Power(VF x, VF power) {
  const VF exponent = hn::Max(hn::Mul(Log(hn::Max(x, Set(1e-30f))), power), Set(-80));
  return hn::Max(hn::Add(ExpMinus1(exponent), Set(1)), hn::Zero(DF()));
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
