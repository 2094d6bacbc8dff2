#include "io/dicom/voxels.h"

#include <algorithm>
#include <limits>

namespace volumen::dicom {
namespace {

template <class To, class From>
bool represents(From value) {
  return double(To(value)) == double(value);
}

/// Returns whether `To` can hold this value.
template <class To, class From>
bool fits(From value) {
  constexpr double low = double(std::numeric_limits<To>::lowest()),
                   high = double(std::numeric_limits<To>::max());
  return double(value) >= low && double(value) <= high && represents<To>(value);
}

/// Copies samples that are of the wanted type or fit it. Returns false if one does not fit.
template <class To, class From>
bool copyExactly(const std::vector<From>& from, To* to) {
  if constexpr (std::is_same_v<To, From>) {
    std::copy(from.begin(), from.end(), to);
    return true;
  } else {
    for (std::size_t n = 0; n < from.size(); ++n) {
      if (!fits<To>(from[n])) return false;
      to[n] = To(from[n]);
    }
    return true;
  }
}

float realValue(const Slice& slice, double stored) { return float(slice.slope * stored + slice.intercept); }

/// Rescales values. Returns true if a sample is wider than float32 holds exactly.
template <class From>
bool rescale(const std::vector<From>& from, const Slice& slice, float* to) {
  bool inexact = false;
  for (std::size_t n = 0; n < from.size(); ++n) {
    inexact =
        inexact || (sizeof(From) > 2 && double(float(from[n])) != double(from[n]) && from[n] == from[n]);
    to[n] = realValue(slice, double(from[n]));
  }
  return inexact;
}

/// Sets padded voxels to `value`. Returns false if it does not fit.
template <class To, class From>
bool fillPadding(const std::vector<From>& from, ValueRange padding, double value, To* to) {
  for (std::size_t n = 0; n < from.size(); ++n) {
    if (double(from[n]) < padding.low || double(from[n]) > padding.high) continue;
    if (!std::is_same_v<To, float> && !fits<To>(value)) return false;
    to[n] = To(value);
  }
  return true;
}

/// Returns the range of a slice's padding in real values.
ValueRange realPadding(const Slice& slice) {
  const double a = realValue(slice, slice.padding->low), b = realValue(slice, slice.padding->high);
  return {std::min(a, b), std::max(a, b)};
}

bool padAlike(const Slice& a, const Slice& b) {
  return a.padding == b.padding && a.slope == b.slope && a.intercept == b.intercept;
}

}  // namespace

std::optional<Padding> paddingOf(std::span<const PlacedSlice> slices) {
  const auto isPadded = [](const PlacedSlice& s) { return s.slice->padding.has_value(); };
  if (std::ranges::none_of(slices, isPadded)) return {};
  const Slice& first = slices[0].slice;
  if (std::ranges::all_of(slices, [&](const PlacedSlice& s) { return padAlike(s.slice, first); }))
    return Padding{realPadding(first), {}};
  std::optional<Padding> lowest;
  for (const PlacedSlice& s : slices) {
    if (!isPadded(s)) continue;
    const double low = realPadding(s.slice).low;
    if (lowest && lowest->values.low <= low) continue;
    lowest = Padding{{low, low}, s.slice->slope < 0 ? s.slice->padding->high : s.slice->padding->low};
  }
  return lowest;
}

Stored storeSamples(const Samples& samples, const Slice& slice, const ValuePlan& plan,
                    const std::optional<Padding>& padding, std::size_t offset, VoxelValues& volume) {
  Stored noticed;
  std::visit(
      [&](const auto& from, auto& to) {
        using To = typename std::decay_t<decltype(to)>::value_type;
        if constexpr (std::is_same_v<To, float>) {
          if (plan.rescaled)
            noticed.inexact = rescale(from, slice, to.data() + offset);
          else
            noticed.doesNotFit = !copyExactly(from, to.data() + offset);
        } else {
          noticed.doesNotFit = !copyExactly(from, to.data() + offset);
        }
        if (!padding || !padding->one || !slice.padding) return;
        const double value = plan.rescaled ? padding->values.low : *padding->one;
        if (!fillPadding(from, *slice.padding, value, to.data() + offset)) noticed.doesNotFit = true;
      },
      samples, volume);
  return noticed;
}

}  // namespace volumen::dicom
