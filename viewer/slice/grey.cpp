#include "viewer/slice/grey.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/slice/grey.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Writes floor(times (value - middle) / width + 128), clamped to 0 .. 255, for each value; `outside` for NaN.
void RampBytes(const float* values, std::size_t count, double middle, double times, double width, int outside,
               std::uint8_t* bytes) {
  const hn::ScalableTag<double> dd;
  const hn::Rebind<float, decltype(dd)> df;
  const hn::Rebind<std::int32_t, decltype(dd)> di;
  const hn::Rebind<std::uint8_t, decltype(dd)> d8;
  const auto byteOf = [=](auto stored) {
    const auto value = hn::PromoteTo(dd, stored);
    const auto ramp =
        hn::Add(hn::Div(hn::Mul(hn::Sub(value, hn::Set(dd, middle)), hn::Set(dd, times)), hn::Set(dd, width)),
                hn::Set(dd, 128));
    const auto byte = hn::Min(hn::Max(ramp, hn::Zero(dd)), hn::Set(dd, 255));
    const auto known = hn::IfThenElse(hn::Eq(value, value), byte, hn::Set(dd, double(outside)));
    return hn::DemoteTo(d8, hn::DemoteTo(di, known));
  };
  const std::size_t lanes = hn::Lanes(dd);
  std::size_t n = 0;
  for (; n + lanes <= count; n += lanes) hn::StoreU(byteOf(hn::LoadU(df, values + n)), d8, bytes + n);
  HWY_ALIGN std::uint8_t one[hn::MaxLanes(d8)];
  for (; n < count; ++n) {
    hn::StoreU(byteOf(hn::Set(df, values[n])), d8, one);
    bytes[n] = one[0];
  }
}

auto ChooseRampBytes() { return RampBytes; }

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(ChooseRampBytes);

namespace {

// Centre and width of LINEAR; width 0 means a step (C.11.2.1.2.1).
double linearMiddle(const Window& w) { return w.centre - 0.5; }
double linearWidth(const Window& w) { return std::max(w.width, 1.0) - 1; }

double stepOrRamp(double value, double middle, double width) {
  if (width == 0) return value > middle ? 1 : 0;
  return std::clamp((value - middle) / width + 0.5, 0.0, 1.0);
}

double tableGrey(double value, const GreyTable& table) {
  const double last = double(table.grey.size() - 1);
  return table.grey[std::size_t(std::clamp(std::floor(value - table.first + 0.5), 0.0, last))];
}

double uprightGrey(double value, const GreyMapping& m) {
  const Window& w = m.window;
  if (!m.table.grey.empty()) return tableGrey(value, m.table);
  if (m.function == WindowFunction::sigmoid) return 1 / (1 + std::exp(-4 * (value - w.centre) / w.width));
  if (m.function == WindowFunction::linear) return stepOrRamp(value, linearMiddle(w), linearWidth(w));
  return stepOrRamp(value, w.centre, w.width);
}

std::uint8_t byteOf(double value, const GreyMapping& mapping, std::uint8_t outside) {
  if (std::isnan(value)) return outside;
  return std::uint8_t(255 * std::clamp(greyOf(value, mapping), 0.0, 1.0) + 0.5);
}

}  // namespace

double greyOf(double value, const GreyMapping& mapping) {
  if (std::isnan(value)) return value;
  const double grey = uprightGrey(value, mapping);
  return mapping.inverted ? 1 - grey : grey;
}

std::vector<std::uint8_t> greyBytes(std::span<const float> values, const GreyMapping& mapping,
                                    std::uint8_t outside) {
  std::vector<std::uint8_t> bytes(values.size());
  const bool linear = mapping.function == WindowFunction::linear;
  const double middle = linear ? linearMiddle(mapping.window) : mapping.window.centre,
               width = linear ? linearWidth(mapping.window) : mapping.window.width;
  if (!mapping.table.grey.empty() || mapping.function == WindowFunction::sigmoid || width == 0)
    std::transform(values.begin(), values.end(), bytes.begin(),
                   [&](float v) { return byteOf(double(v), mapping, outside); });
  else
    HWY_DYNAMIC_DISPATCH(ChooseRampBytes)
  ()(values.data(), values.size(), middle, mapping.inverted ? -255 : 255, width, outside, bytes.data());
  return bytes;
}

}  // namespace volumen
#endif  // HWY_ONCE
