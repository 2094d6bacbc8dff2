#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/study/series.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/histogram.h"

namespace volumen {

/// A loaded series and what the panels want to know of it: made once by the loader, then only read.
struct LoadedSeries {
  Series series;
  VolumePtr volume;               ///< the drawn grid
  std::vector<Warning> warnings;  ///< the series' and those of loading
  Histogram histogram;
  Window window;  ///< where the scene has none: the file's, else P0.1 .. P99.9 (picture.md 8)
  std::optional<Window> flatWindow;  ///< of planes, where files have none (slices.md 1); none: `window`
  double valueSpread = 1;            ///< P99.9 - P0.1, > 0
  std::optional<ValueRange> usual;   ///< usualRange(), of values without a unit
  Scene firstScene;                  ///< the automatic preset's
};

using LoadedSeriesPtr = std::shared_ptr<const LoadedSeries>;

/// Whether two are one series, with or without its table.
inline bool areOneSeries(const LoadedSeriesPtr& a, const LoadedSeriesPtr& b) {
  return a == b || (a && b && a->series.path == b->series.path && a->series.id == b->series.id);
}

}  // namespace volumen
