#pragma once

#include <vector>

#include "results/series/time_points.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// Returns the time points of a series that the workspace knows, itself included, in order.
std::vector<const Series*> timePointsOf(const Workspace& workspace, const SeriesKey& series);

/// Returns timePointText() of a series among the time points that the workspace knows; empty if it knows
/// none.
QString timePointText(const Workspace& workspace, const SeriesKey& series);

/// Returns whether there are several.
bool hasTimePoints(const Workspace& workspace, const SeriesKey& series);

/// Makes the open time points of a series known to the workspace.
Workspace withTimePointsOf(Workspace workspace, const Series& series, const std::vector<const Series*>& open);

/// Shows another time point in a view, or in all views of its group, as the last one was shown.
Workspace withTimePoint(Workspace workspace, ViewId view, const SeriesKey& step);

}  // namespace volumen
