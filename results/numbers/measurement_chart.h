#pragma once

#include <QColor>
#include <QPointF>
#include <QString>
#include <optional>
#include <span>
#include <vector>

#include "results/series/loaded_series.h"
#include "results/series/time_points.h"
#include "viewer/measure/measure.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// The charts of the values under a measurement.
enum class ChartKind {
  profile,    ///< along a length or polyline
  histogram,  ///< distribution of a region
  overTime    ///< mean of a region at each time point of its series
};

/// Returns "Profile", "Histogram" or "Over time".
QString chartText(ChartKind kind);

/// Name and colour of a line in a chart of several things.
struct ChartLineLook {
  QString name;
  QColor colour;
  bool operator==(const ChartLineLook&) const = default;
};

/// Values of a measurement or of segments along an axis, with the titles of both axes.
struct MeasuredChart {
  QString xTitle, yTitle;
  std::vector<std::vector<QPointF>> lines;  ///< each without gaps
  bool marked = false;                      ///< marks each point, as few were measured
  QString problem;                          ///< why the chart is empty or incomplete
  std::vector<ChartLineLook> looks{};       ///< one per line; empty: all lines belong to one thing
  std::vector<std::vector<double>> sds{};   ///< one for each point of each line; empty: not given
  bool operator==(const MeasuredChart&) const = default;
};

/// Returns the values along a line of patient points, with gaps outside the volume. `length` is the line's
/// length.
MeasuredChart profileChart(std::span<const glm::dvec3> line, const Volume& volume, const ValueScale& scale,
                           Interpolation interpolation, const Measured& length);

/// Returns a histogram as a staircase, of a region or of counted values. `counted` is the word for voxels.
MeasuredChart histogramChart(const ValueCounts& counts, const ValueScale& scale, const QString& counted);
MeasuredChart histogramChart(const Shape& region, const Volume& volume, const ValueScale& scale,
                             const QString& counted);

/// Returns the means of a region along `axis`. Positions without a mean are left out.
MeasuredChart timeChart(const StepAxis& axis, const std::vector<std::optional<double>>& means,
                        const std::string& unit);

/// Returns CSV (RFC 4180): a header, then a row per point. Lines with names have them in the first column; an
/// SD comes last. An empty row separates lines.
QString chartAsCsv(const MeasuredChart& chart);

}  // namespace volumen
