#pragma once

#include <vector>

#include "ui/data/series_pool.h"
#include "ui/workspace/requests.h"

namespace volumen {

/// Why a series must be in memory; the earlier reason is the more urgent one.
enum class NeededFor { request, screen, later };

struct NeededSeries {
  std::shared_ptr<const Series> series;
  NeededFor reason;
};

/// Returns the volumes of the series and overlays on screen with their masks. The view in focus comes first,
/// but the source of a curved reformat before the reformat.
std::vector<PoolKey> seriesOnScreen(const Workspace& workspace);

/// Returns the series that have to be read, most needed first: the one to be shown, those on screen, and, if
/// memory has room for them, the time points next to the one in focus.
std::vector<NeededSeries> neededSeries(const Workspace& workspace, const Requests& requests,
                                       const SeriesPool& inMemory);

}  // namespace volumen
