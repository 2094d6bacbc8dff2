// Conversion of pixels to the screen format.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/volume/argb.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "viewer/volume/picture.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void ToArgb(const float* rgba, std::size_t count, std::uint32_t* argb) {
  std::size_t n = 0;
#if HWY_TARGET != HWY_SCALAR  // the scalar target has no interleaving
  const hn::ScalableTag<float> df;
  const hn::RebindToSigned<decltype(df)> di;
  using VF = hn::Vec<decltype(df)>;
  using VI = hn::Vec<decltype(di)>;
  const VF zero = hn::Zero(df), one = hn::Set(df, 1), half = hn::Set(df, 0.5f), all = hn::Set(df, 256);
  // Computes toByte() in floats for x in 0..1: 255 x is rounded, and its rounding error is known exactly.
  const auto byteOf = [&](VF x) {
    const VF more = hn::Mul(x, all), scaled = hn::Sub(more, x), lost = hn::Sub(hn::Sub(more, scaled), x);
    const VI whole = hn::ConvertTo(di, hn::Add(scaled, half));
    const VF above = hn::Sub(scaled, hn::Sub(hn::ConvertTo(df, whole), half));
    // Rounding may have raised it to the next byte, but never lowered it.
    return hn::Sub(
        whole, hn::IfThenElseZero(hn::RebindMask(di, hn::Lt(hn::Add(above, lost), zero)), hn::Set(di, 1)));
  };
  for (; n + hn::Lanes(df) <= count; n += hn::Lanes(df)) {
    VF r, g, b, a;
    hn::LoadInterleaved4(df, rgba + 4 * n, r, g, b, a);
    const auto byte = [&](VF x) { return byteOf(hn::Min(hn::Max(hn::Min(x, a), zero), one)); };
    const auto ar = hn::Or(hn::ShiftLeft<24>(byte(a)), hn::ShiftLeft<16>(byte(r)));
    const auto gb = hn::Or(hn::ShiftLeft<8>(byte(g)), byte(b));
    hn::StoreU(hn::Or(ar, gb), di, reinterpret_cast<std::int32_t*>(argb + n));
  }
#endif
  for (; n < count; ++n) {
    const float* p = rgba + 4 * n;
    const auto byte = [&](int c) { return std::uint32_t(toByte(std::min(p[c], p[3]))); };
    argb[n] = byte(3) << 24 | byte(0) << 16 | byte(1) << 8 | byte(2);
  }
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(ToArgb);
void toArgb(const float* rgba, std::size_t count, std::uint32_t* argb) {
  HWY_DYNAMIC_DISPATCH(ToArgb)(rgba, count, argb);
}

}  // namespace volumen
#endif  // HWY_ONCE
