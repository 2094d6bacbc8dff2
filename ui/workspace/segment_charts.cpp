#include "ui/workspace/segment_charts.h"

#include "ui/workspace/region_colours.h"
#include "ui/workspace/text.h"

namespace volumen {

ChartLineLook lookOf(const Segment& segment) {
  return {shownText(segment.label), regionColour(segment.colour, segment.number)};
}

MeasuredChart segmentHistograms(std::span<const SegmentReport> segments, const ValueScale& scale) {
  MeasuredChart all = histogramChart(ValueCounts{}, scale, tr("Voxels"));
  QStringList without;
  for (const SegmentReport& report : segments) {
    MeasuredChart chart = histogramChart(report.values.histogram, scale, {});
    const ChartLineLook look = lookOf(report.segment);
    if (chart.lines.empty()) {
      without << look.name;
      continue;
    }
    all.lines.push_back(std::move(chart.lines.front()));
    all.looks.push_back(look);
  }
  if (!without.isEmpty()) all.problem = tr("Without values: %1").arg(without.join(QStringLiteral(", ")));
  return all;
}

}  // namespace volumen
