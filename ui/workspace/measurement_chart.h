#pragma once

#include <QColor>
#include <QPointF>
#include <QString>
#include <optional>
#include <span>
#include <vector>

#include "ui/data/loaded_series.h"
#include "ui/workspace/time_point_text.h"
#include "viewer/measure/measure.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// What is drawn of the values under a measurement.
enum class ChartKind {
  profile,    ///< along a length or polyline
  histogram,  ///< of a region
  overTime    ///< the mean of a region at each of the steps of its series
};

/// "Profile", "Histogram", "Over time".
QString chartText(ChartKind kind);

/// Those that a measurement has, the first one by default; none: its values make no chart.
std::vector<ChartKind> chartsOf(const Workspace& workspace, const Measurement& measurement);

/// Whose values a line shows, where a chart has those of several things.
struct ChartLineLook {
  QString name;
  QColor colour;
  bool operator==(const ChartLineLook&) const = default;
};

/// Values of a measurement or of segments along an axis, with what the axes say.
struct MeasuredChart {
  QString xTitle, yTitle;
  std::vector<std::vector<QPointF>> lines;  ///< each runs on without a gap
  bool marked = false;                      ///< with a mark at each point: few that were measured
  QString problem;                          ///< why there is nothing, or less than there might be
  std::vector<ChartLineLook> looks{};       ///< one a line; empty: all are of one thing
  std::vector<std::vector<double>> sds{};   ///< of each point of each line; empty: none is told
  bool operator==(const MeasuredChart&) const = default;
};

/// The values along a line of patient points, whose length is told by `length`; gaps where it is outside.
MeasuredChart profileChart(std::span<const glm::dvec3> line, const Volume& volume, const ValueScale& scale,
                           Interpolation interpolation, const Measured& length);

/// A staircase: how many voxels have which values, of a region or as they were counted. `counted`: what
/// voxels are called there.
MeasuredChart histogramChart(const ValueCounts& counts, const ValueScale& scale, const QString& counted);
MeasuredChart histogramChart(const Shape& region, const Volume& volume, const ValueScale& scale,
                             const QString& counted);

/// The means of a region at these places; a place without one is left out.
MeasuredChart timeChart(const StepAxis& axis, const std::vector<std::optional<double>>& means,
                        const std::string& unit);

/// RFC 4180: a line of headings, then a line a point, in front the name where lines have names, behind it
/// the SD where there is one; lines are parted by an empty row.
QString chartAsCsv(const MeasuredChart& chart);

}  // namespace volumen
