#include "io/export/dicom_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include "io/export/dicom_elements.h"

namespace volumen {

namespace {

double asWritten(double value) { return std::strtod(decimal(value).c_str(), nullptr); }

using Padding = std::optional<ValueRange>;

// Gives padding a stored number that no other value of the slice uses. Returns false if both `low` and `high`
// are in use.
bool renumberPadding(std::span<const float> values, const Padding& padding, int low, int high,
                     StoredSlice& slice) {
  for (const int number : {low, high}) {
    const auto word = std::uint16_t(number);
    bool isFree = true;
    for (std::size_t n = 0; n < values.size() && isFree; ++n)
      isFree = slice.words[n] != word || isPadding(padding, values[n]);
    if (!isFree) continue;
    for (std::size_t n = 0; n < values.size(); ++n)
      if (isPadding(padding, values[n])) slice.words[n] = word;
    slice.padding = number;
    return true;
  }
  return false;
}

// Rescales values to the nearest stored number, clamped to the range of 16 bits.
StoredSlice rescaled(std::span<const float> values, StoredAs as, const Padding& padding) {
  StoredSlice slice;
  slice.isSigned = as.isSigned;
  slice.slope = asWritten(as.slope);
  slice.intercept = asWritten(as.intercept);
  const int low = as.isSigned ? -32768 : 0, high = as.isSigned ? 32767 : 65535;
  double paddingError = 0;
  slice.words.reserve(values.size());
  for (const float v : values) {
    const double stored =
        std::clamp(std::floor((double(v) - slice.intercept) / slice.slope + 0.5), double(low), double(high));
    slice.words.push_back(std::uint16_t(std::int32_t(stored)));
    const double written = double(float(slice.slope * stored + slice.intercept));
    double& largest = isPadding(padding, v) ? paddingError : slice.largestError;
    largest = std::max(largest, std::abs(written - double(v)));
    if (isPadding(padding, v) && padding->low == padding->high) slice.padding = int(stored);
  }
  if (paddingError > 0 && !renumberPadding(values, padding, low, high, slice)) {
    slice.largestError = std::max(slice.largestError, paddingError);
    slice.padding.reset();
  }
  return slice;
}

StoredSlice rounded(std::span<const float> values, const Padding& padding) {
  const auto [low, high] = std::ranges::minmax(values);
  const bool isSigned = low < 0;
  const double most = std::max(double(high), -double(low));
  return rescaled(values, {most > 0 ? most / (isSigned ? 32767 : 65535) : 1, 0, isSigned}, padding);
}

template <class Sample>
StoredSlice asTheyAre(std::span<const Sample> values, const Volume& volume) {
  StoredSlice slice;
  slice.isSigned = std::is_signed_v<Sample>;
  slice.slope = volume.slope();
  slice.intercept = volume.intercept();
  slice.words.reserve(values.size());
  for (const Sample v : values) slice.words.push_back(std::uint16_t(std::int32_t(v)));
  return slice;
}

// Stores floats that are whole numbers without rounding; empty if some are not.
std::optional<StoredSlice> wholeSlice(std::span<const float> values, const Volume& volume) {
  StoredSlice slice = rescaled(values, {1, 0, true}, {});
  if (slice.largestError > 0) return {};
  slice.slope = volume.slope();
  slice.intercept = volume.intercept();
  return slice;
}

std::optional<StoredSlice> realSlice(std::span<const float> values, const std::optional<StoredAs>& source,
                                     const Padding& padding, bool mayRound) {
  if (source && source->slope != 0)
    if (StoredSlice exact = rescaled(values, *source, padding); exact.largestError == 0) return exact;
  if (StoredSlice whole = rescaled(values, {1, 0, true}, padding); whole.largestError == 0) return whole;
  if (mayRound) return rounded(values, padding);
  return {};
}

std::span<const float> floatsOf(const Volume& volume, int k) {
  const std::size_t count = std::size_t(volume.size().x) * std::size_t(volume.size().y);
  return std::span(std::get<std::vector<float>>(volume.stored())).subspan(std::size_t(k) * count, count);
}

bool isExact(const Volume& volume, StoredAs as) {
  for (int k = 0; k < volume.size().z; ++k)
    if (roundedSlice(volume, k, as).largestError > 0) return false;
  return true;
}

}  // namespace

StoredAs storedAsOne(const Volume& volume, const std::optional<StoredAs>& source) {
  if (source && source->slope != 0 && isExact(volume, *source)) return *source;
  if (const StoredAs whole{1, 0, true}; isExact(volume, whole)) return whole;
  const auto [low, high] = std::ranges::minmax(std::get<std::vector<float>>(volume.stored()));
  return {high > low ? (double(high) - double(low)) / 65535 : 1, low, false};
}

StoredSlice roundedSlice(const Volume& volume, int k, StoredAs as) {
  return rescaled(floatsOf(volume, k), as, volume.attributes().padding);
}

std::optional<StoredSlice> storedSlice(const Volume& volume, int k, const std::optional<StoredAs>& source,
                                       bool mayRound) {
  const std::size_t count = std::size_t(volume.size().x) * std::size_t(volume.size().y);
  return std::visit(
      [&]<class Sample>(const std::vector<Sample>& all) -> std::optional<StoredSlice> {
        const std::span<const Sample> values = std::span(all).subspan(std::size_t(k) * count, count);
        if constexpr (!std::is_same_v<Sample, float>)
          return asTheyAre(values, volume);
        else if (volume.slope() == 1 && volume.intercept() == 0)
          return realSlice(values, source, volume.attributes().padding, mayRound);
        else
          return wholeSlice(values, volume);
      },
      volume.stored());
}

}  // namespace volumen
