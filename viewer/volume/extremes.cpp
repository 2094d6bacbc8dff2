#include "viewer/volume/extremes.h"

#include <algorithm>
#include <cstdint>
#include <tuple>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/volume/extremes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
std::pair<T, T> RangeOf(const T* values, std::size_t count) {
  const hn::ScalableTag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  std::pair<T, T> range{values[0], values[0]};
  std::size_t n = 0;
  if (count >= lanes) {
    auto low = hn::LoadU(d, values), high = low;
    for (; n + lanes <= count; n += lanes) {
      const auto v = hn::LoadU(d, values + n);
      low = hn::Min(low, v);
      high = hn::Max(high, v);
    }
    HWY_ALIGN T ends[2][hn::MaxLanes(d)];
    hn::Store(low, d, ends[0]);
    hn::Store(high, d, ends[1]);
    range = {*std::min_element(ends[0], ends[0] + lanes), *std::max_element(ends[1], ends[1] + lanes)};
  }
  for (; n < count; ++n) range = {std::min(range.first, values[n]), std::max(range.second, values[n])};
  return range;
}

template <class T>
void TakeInRange(const T* values, std::size_t count, T* low, T* high) {
  const hn::ScalableTag<T> d;
  std::size_t n = 0;
  for (; n + hn::Lanes(d) <= count; n += hn::Lanes(d)) {
    const auto v = hn::LoadU(d, values + n);
    hn::StoreU(hn::Min(hn::LoadU(d, low + n), v), d, low + n);
    hn::StoreU(hn::Max(hn::LoadU(d, high + n), v), d, high + n);
  }
  for (; n < count; ++n) {
    low[n] = std::min(low[n], values[n]);
    high[n] = std::max(high[n], values[n]);
  }
}

template <class T>
void TakeInDistance(const T* a, const T* b, std::size_t count, Distance<T>* most) {
  const hn::ScalableTag<T> d;
  const hn::ScalableTag<Distance<T>> dd;
  std::size_t n = 0;
  for (; n + hn::Lanes(d) <= count; n += hn::Lanes(d)) {
    const auto p = hn::LoadU(d, a + n), q = hn::LoadU(d, b + n);
    const auto distance = hn::BitCast(dd, hn::Sub(hn::Max(p, q), hn::Min(p, q)));
    hn::StoreU(hn::Max(hn::LoadU(dd, most + n), distance), dd, most + n);
  }
  for (; n < count; ++n)
    most[n] = std::max(most[n], Distance<T>(std::max(a[n], b[n]) - std::min(a[n], b[n])));
}

template <class T>
constexpr RowPasses<T> kPasses{RangeOf<T>, TakeInRange<T>, TakeInDistance<T>};

auto Passes() {
  static constexpr std::tuple all{kPasses<std::uint8_t>, kPasses<std::int16_t>, kPasses<std::uint16_t>,
                                  kPasses<float>};
  return &all;
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(Passes);

template <class T>
const RowPasses<T>& rowPasses() {
  return std::get<RowPasses<T>>(*HWY_DYNAMIC_DISPATCH(Passes)());
}

template const RowPasses<std::uint8_t>& rowPasses<std::uint8_t>();
template const RowPasses<std::int16_t>& rowPasses<std::int16_t>();
template const RowPasses<std::uint16_t>& rowPasses<std::uint16_t>();
template const RowPasses<float>& rowPasses<float>();

}  // namespace volumen
#endif  // HWY_ONCE
