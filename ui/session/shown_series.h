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
  VolumePtr volume;                   ///< the drawn grid
  std::vector<std::string> warnings;  ///< the series' and those of loading, one sentence each
  Histogram histogram;
  Scene firstScene;  ///< the automatic preset's
  /// The same with its table, where that was removed from the volume; else null.
  std::shared_ptr<const ShownSeries> withTable;
};

using ShownSeriesPtr = std::shared_ptr<const ShownSeries>;

/// Whether two are one series, with or without its table.
inline bool areOneSeries(const ShownSeriesPtr& a, const ShownSeriesPtr& b) {
  const auto whole = [](const ShownSeriesPtr& s) { return s && s->withTable ? s->withTable : s; };
  return whole(a) == whole(b);
}

}  // namespace volumen
