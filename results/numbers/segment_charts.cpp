#include "results/numbers/segment_charts.h"

#include "results/segments/region_colours.h"
#include "results/text/text.h"

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
