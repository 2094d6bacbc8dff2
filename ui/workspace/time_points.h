#pragma once

#include <vector>

#include "ui/workspace/workspace.h"

namespace volumen {

/// Returns whether two volumes are time points of one series. They have the same patient, series and grid,
/// and differ in time, echo, diffusion weighting or direction, or they are volumes of one file.
bool areTimePoints(const Series& a, const Series& b);

/// Sorts time points by the attribute that varies.
void sortTimePoints(std::vector<const Series*>& steps);

/// Returns the time points of a series that the workspace knows, itself included, in order.
std::vector<const Series*> timePointsOf(const Workspace& workspace, const SeriesKey& series);

/// Returns whether there are several.
bool hasTimePoints(const Workspace& workspace, const SeriesKey& series);

/// Makes the open time points of a series known to the workspace.
Workspace withTimePointsOf(Workspace workspace, const Series& series, const std::vector<const Series*>& open);

/// Shows another time point in a view, or in all views of its group, as the last one was shown.
Workspace withTimePoint(Workspace workspace, ViewId view, const SeriesKey& step);

}  // namespace volumen
