#include "ui/workspace/segment_surfaces.h"

#include <QStringList>
#include <algorithm>
#include <utility>

#include "ui/workspace/region_colours.h"
#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"

namespace volumen {

QString notDrawnText(const std::vector<SegmentNotDrawn>& segments) {
  QStringList reasons, lines;
  for (const SegmentNotDrawn& one : segments)
    if (!reasons.contains(one.whyNot)) reasons << one.whyNot;
  for (const QString& reason : reasons) {
    QStringList names;
    for (const SegmentNotDrawn& one : segments)
      if (one.whyNot == reason) names << shownText(one.segment->label);
    lines << tr("Not drawn in 3D: %1. %2").arg(names.join(QStringLiteral(", ")), reason);
  }
  return lines.join(QLatin1Char('\n'));
}

std::vector<const Segment*> segmentsIn3d(const SegmentMap& map) {
  std::vector<const Segment*> shown;
  for (const Segment& segment : map.segments)
    if (map.in3d && segment.visible && segment.opacity > 0) shown.push_back(&segment);
  return shown;
}

SegmentSurface surfaceOf(const Segment& segment, FieldPtr field) {
  const QColor colour = regionColour(segment.colour, segment.number);
  return {std::move(field), glm::dvec3(colour.red(), colour.green(), colour.blue()) / 255.0, segment.opacity};
}

std::vector<SeriesKey> seriesIn3d(const Workspace& workspace) {
  std::vector<SeriesKey> all;
  for (const ViewId id : viewsOnScreen(workspace)) {
    const ViewState& view = workspace.view(id);
    if (showsScene(view.kind) && std::ranges::find(all, view.series) == all.end()) all.push_back(view.series);
  }
  return all;
}

}  // namespace volumen
