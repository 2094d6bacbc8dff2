#pragma once

#include <vector>

#include "ui/workspace/workspace.h"

namespace volumen {

/// Whether two volumes are steps of one series: of one patient, series and grid, at different times, echoes,
/// diffusion weights or directions, or the volumes of one file.
bool areTimePoints(const Series& a, const Series& b);

/// Brings steps into their order: that of what varies.
void sortTimePoints(std::vector<const Series*>& steps);

/// The steps of a series that the workspace knows, itself included, in the order of what varies.
std::vector<const Series*> timePointsOf(const Workspace& workspace, const SeriesKey& series);

/// Whether there are several.
bool hasTimePoints(const Workspace& workspace, const SeriesKey& series);

/// With the steps of a series known, of all that are open.
Workspace withTimePointsOf(Workspace workspace, const Series& series, const std::vector<const Series*>& open);

/// With another step of what a view shows, in all views of its group, shown as the last one was.
Workspace withTimePoint(Workspace workspace, ViewId view, const SeriesKey& step);

}  // namespace volumen
