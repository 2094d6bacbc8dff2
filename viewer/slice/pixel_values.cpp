#include "viewer/slice/pixel_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace volumen {

namespace {

template <class T>
constexpr std::size_t kindsOf = std::size_t(1) << (8 * sizeof(T));

template <class T>
constexpr std::size_t kindOf(T stored) {
  return std::size_t(int(stored) - int(std::numeric_limits<T>::min()));
}

// Returns the values of all integers of a type, in ascending order of the integers.
template <class T>
std::vector<float> valuesOfAll(const PixelValues& values) {
  std::vector<float> all(kindsOf<T>);
  for (std::size_t n = 0; n < all.size(); ++n)
    all[n] = values.of(double(n) + double(std::numeric_limits<T>::min()));
  return all;
}

// Returns how often each integer occurs. Neighbours are often equal. Four tables in turn keep a count from
// waiting for the one before.
template <class T>
std::vector<std::int64_t> countsOfAll(const std::vector<T>& stored) {
  std::array<std::vector<std::uint32_t>, 4> parts;
  parts.fill(std::vector<std::uint32_t>(kindsOf<T>));
  const std::size_t fours = stored.size() / 4 * 4;
  for (std::size_t n = 0; n < fours; n += 4)
    for (std::size_t part = 0; part < 4; ++part) ++parts[part][kindOf(stored[n + part])];
  for (std::size_t n = fours; n < stored.size(); ++n) ++parts[0][kindOf(stored[n])];
  std::vector<std::int64_t> counts(kindsOf<T>);
  for (const auto& part : parts)
    std::ranges::transform(counts, part, counts.begin(), std::plus<std::int64_t>());
  return counts;
}

}  // namespace

float ValueMapping::operator()(double stored) const {
  constexpr double most = 1e30;  // limit of volumes (design.md 10)
  if (!table.empty()) return table[std::size_t(std::clamp(stored - first, 0.0, double(table.size() - 1)))];
  return float(std::clamp(slope * stored + intercept, -most, most));
}

std::size_t PixelValues::size() const {
  return std::visit([](const auto& v) { return v.size(); }, stored);
}

float PixelValues::operator[](std::size_t n) const {
  return std::visit([&](const auto& v) { return of(double(v[n])); }, stored);
}

std::vector<float> PixelValues::floats(std::size_t first, std::size_t count) const {
  return std::visit(
      [&]<class T>(const std::vector<T>& v) {
        const auto some = std::span(v).subspan(first, count);
        if constexpr (std::is_same_v<T, float>) {
          return std::vector<float>(some.begin(), some.end());
        } else {
          std::vector<float> values(count);
          std::ranges::transform(some, values.begin(), [&](T each) { return of(double(each)); });
          return values;
        }
      },
      stored);
}

bool PixelValues::anyNegative() const {
  return std::visit(
      [&]<class T>(const std::vector<T>& v) {
        if (std::is_unsigned_v<T> && slope >= 0 && intercept >= 0) return false;
        return std::ranges::any_of(v, [&](T each) { return of(double(each)) < 0; });
      },
      stored);
}

std::vector<std::uint8_t> PixelValues::greyBytes(const GreyMapping& mapping) const {
  return std::visit(
      [&]<class T>(const std::vector<T>& v) {
        if constexpr (!std::is_same_v<T, float>) {
          if (v.size() >= kindsOf<T>) {
            const std::vector<std::uint8_t> greys = volumen::greyBytes(valuesOfAll<T>(*this), mapping);
            std::vector<std::uint8_t> bytes(v.size());
            std::ranges::transform(v, bytes.begin(), [&](T each) { return greys[kindOf(each)]; });
            return bytes;
          }
        }
        return volumen::greyBytes(floats(), mapping);
      },
      stored);
}

void SharedWindow::add(const PixelValues& values, const std::optional<ValueRange>& padding) {
  const auto count = [&](float value, std::int64_t times) {
    if (times == 0 || !std::isfinite(value) || isPadding(padding, value)) return;
    counted_.push_back({value, times});
    count_ += times;
  };
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        if constexpr (std::is_same_v<T, float>) {
          for (const float value : stored) count(value, 1);
        } else {
          const std::vector<std::int64_t> counts = countsOfAll(stored);
          const std::vector<float> all = valuesOfAll<T>(values);
          for (std::size_t n = 0; n < all.size(); ++n) count(all[n], counts[n]);
        }
      },
      values.stored);
}

Window SharedWindow::window() const {
  if (counted_.empty()) return {0.5, 1};
  std::vector<Counted> all = counted_;
  const bool isOnceEach = count_ == std::int64_t(all.size());
  if (!isOnceEach) std::ranges::sort(all, {}, &Counted::value);
  const auto ranked = [&](std::int64_t perMille) {
    std::int64_t left = std::max<std::int64_t>(1, (perMille * count_ + 999) / 1000);
    auto at = all.begin();
    if (isOnceEach) {
      at += left - 1;
      std::ranges::nth_element(all, at, {}, &Counted::value);
    } else {
      while (left > at->times) left -= (at++)->times;
    }
    return double(at->value);
  };
  const double low = ranked(1), high = ranked(999);
  return {(low + high) / 2, high > low ? high - low : 1};
}

}  // namespace volumen
