#include <QPainter>
#include <algorithm>

#include "results/segments/region_colours.h"
#include "ui/controller/derived_objects.h"
#include "ui/controller/segment_editing.h"
#include "ui/views/clip_lines.h"
#include "ui/views/contour_lines.h"
#include "ui/views/cross_lines.h"
#include "ui/views/flat_view.h"
#include "ui/workspace/key_images.h"

namespace volumen {

namespace {

// Returns the frame of reference; empty if points are not comparable with other series.
std::string frameOfReferenceOf(const LoadedSeriesPtr& shown) {
  return shown && shown->volume->geometry().calibrated ? shown->series.frameOfReferenceUid : std::string();
}

constexpr double fillOfSegments = 0.5;  // of the segment's opacity, so that the picture shows through

// Returns the layer of a segment map; nothing if no segment is visible.
std::optional<SegmentLayer> layerOf(const SegmentMap& map, const Rigid& fromPlane) {
  if (!map.labels) return {};
  SegmentLayer layer{nullptr, {}, fillOfSegments, map.labels, fromPlane};
  for (const Segment& segment : map.segments)
    if (segment.visible && segment.opacity > 0)
      layer.shown.push_back(
          {std::size_t(segment.number), regionColour(segment.colour, segment.number).rgb(), segment.opacity});
  return layer.shown.empty() ? std::nullopt : std::optional(std::move(layer));
}

void paintContours(QPainter& painter, const ContourLines& contours, double pixelRatio) {
  constexpr double arm = 3;  // of a cross, logical pixels
  painter.setBrush(Qt::NoBrush);
  // A dark rim separates contours from bone.
  for (const auto& [colour, width] : {std::pair(QColor(0, 0, 0, 150), 3.0), {contours.colour, 1.5}}) {
    painter.setPen(QPen(colour, width * pixelRatio));
    for (const QPolygonF& line : contours.lines) painter.drawPolyline(line);
    for (const QLineF& cut : contours.cuts) painter.drawLine(cut);
    const double length = arm * pixelRatio;
    for (const QPointF& p : contours.points) {
      painter.drawLine(p - QPointF(length, 0), p + QPointF(length, 0));
      painter.drawLine(p - QPointF(0, length), p + QPointF(0, length));
    }
  }
}

}  // namespace

std::vector<SegmentLayer> FlatView::segmentLayers() const {
  std::vector<SegmentLayer> layers;
  const std::string frame = frameOfReferenceOf(shown());
  for (const auto& [key, look] : session_.workspace().regions) {
    if (look.kind != DerivedKind::segmentation || frame.empty() || look.frameOfReferenceUid != frame)
      continue;
    const auto regions = derived_.regions(key);
    if (!regions || !regions->segmentation) continue;
    SegmentLayer layer{regions->segmentation, {}, look.opacity};
    for (std::size_t n = 0; n < regions->segmentation->segments.size(); ++n) {
      const Segment& segment = regions->segmentation->segments[n];
      if (look.shows(segment.number))
        layer.shown.push_back({n, regionColour(segment.colour, segment.number).rgb()});
    }
    layers.push_back(std::move(layer));
  }
  addSegmentMaps(layers);
  return layers;
}

// Proposed segments lie below the existing ones, and these below those being edited.
void FlatView::addSegmentsOf(const SeriesKey& series, const Rigid& fromPlane,
                             std::vector<SegmentLayer>& layers) const {
  const SegmentMap* worked = segmentMapOf(session_.workspace(), series);
  std::vector<const SegmentMap*> maps = segmentMapsOf(session_.workspace(), series);
  std::ranges::stable_partition(maps, [&](const SegmentMap* map) { return map != worked; });
  const SegmentMap* preview = segments_ ? segments_->previewed() : nullptr;
  if (preview && preview->series == series) maps.insert(maps.begin(), preview);
  for (const SegmentMap* map : maps)
    if (auto layer = layerOf(*map, fromPlane)) layers.push_back(std::move(*layer));
}

// Adds the segments of the series and of the overlaid series. A frame without a position in the patient has
// no grid.
void FlatView::addSegmentMaps(std::vector<SegmentLayer>& layers) const {
  const LoadedSeriesPtr shown = this->shown();
  if (!shown || (shapeFrame() && !shown->volume->geometry().calibrated)) return;
  const Workspace& workspace = session_.workspace();
  addSegmentsOf(state().series, {}, layers);
  const auto over = workspace.series.find(flatLookOf(state()).overlay);
  if (shapeFrame() || over == workspace.series.end()) return;
  const auto relation =
      relationOf(workspace, frameOfReference(*seriesState().series), frameOfReference(*over->second.series));
  if (relation) addSegmentsOf(over->first, relation->toFromFrom, layers);
}

// Paints contours, the clip box and the other planes.
void FlatView::paintLines(QPainter& painter) const {
  const double ratio = devicePixelRatioF();
  const SlicePlane now = *plane();
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.scale(1 / ratio, 1 / ratio);
  const VoxelGeometry& acquired = seriesState().series->acquired;
  for (const auto& [key, regions] : session_.workspace().regions) {
    if (regions.kind != DerivedKind::contours) continue;
    const auto loaded = derived_.regions(key);
    if (!loaded || !loaded->contours) continue;
    const double reachMm = wheelStep(acquired, now.normal()) / 2;
    for (const ContourLines& lines :
         contourLines(*loaded->contours, regions, frameOfReferenceOf(shown()), now, reachMm))
      paintContours(painter, lines, ratio);
  }
  painter.restore();
  if (!showsSlices(state().kind)) return;
  const SlicePress here = *pressAt({});
  paintClipLines(painter, clipLines(here, highlights_.clip));
  paintCrossLines(painter, crossLines(here),
                  here.pixelAt(crosshairOf(session_.workspace(), id(), *shown()).at), rect());
}

QString FlatView::keyImageText() const {
  const std::optional<int> picture = stack().seen.index;
  if (!picture) return {};
  const Series& series = *seriesState().series;
  const std::optional<KeyImage> image = keyImageOf(series, *picture);
  const bool isOfDocument = !derived_.naming(DerivedKind::keyObjects, series, *picture).empty();
  const bool isMarked = isOfDocument || (image && isKeyImage(session_.workspace(), *image));
  return isMarked ? QStringLiteral("\u2605 ") + tr("Key image") : QString();
}

}  // namespace volumen
