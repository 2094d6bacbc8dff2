#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/study/loaded.h"
#include "io/study/series.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/histogram.h"

namespace volumen {

/// A loaded series, with what panels need of it. The loader makes it once; then it is only read.
struct LoadedSeries {
  Series series;
  VolumePtr volume;                       ///< the drawn grid
  std::vector<SliceOrigin> origins = {};  ///< as in Loaded
  std::vector<double> places = {};        ///< as in Loaded
  std::vector<Warning> warnings;          ///< of the series, and of loading
  Histogram histogram;
  Window window;                     ///< of scenes without one: the file's, else P0.1 .. P99.9 (picture.md 8)
  std::optional<Window> flatWindow;  ///< of planes, if files have none (slices.md 1); empty: `window`
  double valueSpread = 1;            ///< P99.9 - P0.1, > 0
  std::optional<ValueRange> usual;   ///< usualRange() of values without a unit
  Scene firstScene;                  ///< scene of the automatic preset
};

using LoadedSeriesPtr = std::shared_ptr<const LoadedSeries>;

/// Returns whether two are the same series, with or without its table.
inline bool areOneSeries(const LoadedSeriesPtr& a, const LoadedSeriesPtr& b) {
  return a == b || (a && b && a->series.path == b->series.path && a->series.id == b->series.id);
}

}  // namespace volumen
