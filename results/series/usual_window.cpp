#include "results/series/usual_window.h"

#include <cmath>

#include "results/text/value_text.h"

namespace volumen {

namespace {

// SUVbw. PET of FDG is read from 0 to 5, 7 or 10; this is the middle one, and digits choose the others.
// Windows in PET files follow the brightest voxel of each slice, which is bladder or brain.
constexpr double mostUptake = 7;

}  // namespace

std::optional<Window> uptakeWindow(const Series& series) {
  if (series.modality != "PT") return {};
  const ValueScale scale = valueScale(series, PetUnit::suvBodyWeight);
  if (!scale.unit.starts_with("SUV")) return {};
  return Window{mostUptake / 2 / scale.factor, mostUptake / scale.factor};
}

Window inUsualSense(const Series& series, const Window& window) {
  const double width = std::abs(window.width);
  return {window.centre, series.modality == "PT" ? -width : width};
}

Window usualWindow(const Series& series, const Window& own) {
  return inUsualSense(series, uptakeWindow(series).value_or(own));
}

}  // namespace volumen
