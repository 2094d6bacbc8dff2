#include "viewer/slice/first_window.h"

#include <numeric>
#include <optional>

#include "viewer/volume/histogram.h"

namespace volumen {

namespace {

// Returns 0 .. P99 above a background of exactly 0, as in diffusion and its maps. There P99.9 would leave
// nearly everything black. Empty for other volumes.
std::optional<ValueRange> aboveBackground(const Volume& volume) {
  constexpr double least = 0.25;  // least fraction of values that makes a background
  if (valueRange(volume).low != 0) return {};
  Histogram values = histogram(volume, 1 << 16);
  if (values.counts.empty() || values.high <= 0) return {};
  const double all = double(std::accumulate(values.counts.begin(), values.counts.end(), std::int64_t(0)));
  if (double(values.counts.front()) < least * all) return {};
  values.counts.front() = 0;
  return ValueRange{0, valueOfRank(values, 0.99)};
}

ValueRange mostValues(const Volume& volume, const std::string& unit) {
  // Values with a unit, such as activity, matter up to the brightest.
  if (unit.empty())
    if (const auto range = aboveBackground(volume)) return *range;
  if (!volume.attributes().padding) {
    const std::vector<float> ends = percentiles(volume, {1, 999});
    return {ends[0], ends[1]};
  }
  const Histogram unpadded = histogram(volume, 1 << 16);
  return {valueOfRank(unpadded, 0.001), valueOfRank(unpadded, 0.999)};
}

}  // namespace

Window firstWindow(const Volume& volume, const std::string& unit) {
  for (const Window& window : volume.attributes().windows)
    if (window.width > 0) return window;
  // HU from air to metal span so much that most tissue would look flat.
  if (unit == "HU") return softTissueWindow;
  const ValueRange range = mostValues(volume, unit);
  const double width = range.high - range.low;
  return {.centre = (range.low + range.high) / 2, .width = width > 0 ? width : 1};
}

GreyMapping windowGrey(const Volume& volume, bool fromDicom, Window window) {
  const bool integers = !std::holds_alternative<std::vector<float>>(volume.stored());
  GreyMapping mapping;
  mapping.window = window;
  if (fromDicom && integers && window.width >= 1) mapping.function = WindowFunction::linear;
  return mapping;
}

}  // namespace volumen
