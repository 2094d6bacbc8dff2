#include "viewer/slice/first_window.h"

#include "viewer/volume/histogram.h"

namespace volumen {

namespace {

// From air to metal HU are so far apart that nearly all of them at once look flat.
constexpr Window softTissue{.centre = 40, .width = 400};

ValueRange mostValues(const Volume& volume) {
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
  if (unit == "HU") return softTissue;
  const ValueRange range = mostValues(volume);
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
