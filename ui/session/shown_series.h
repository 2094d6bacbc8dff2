#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/study.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/histogram.h"

namespace volumen {

/// A loaded series and what the panels want to know of it: made once by the loader, then only read.
struct ShownSeries {
  Series series;
  VolumePtr volume;               ///< the drawn grid
  std::vector<Warning> warnings;  ///< the series' and those of loading
  Histogram histogram;
  Scene firstScene;  ///< the automatic preset's
};

using ShownSeriesPtr = std::shared_ptr<const ShownSeries>;

}  // namespace volumen
