#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "ui/controller/references.h"
#include "ui/data/frame_series.h"
#include "ui/views/contour_lines.h"
#include "ui/views/paint_graphics.h"
#include "ui/views/slice_view.h"
#include "ui/widgets/region_colours.h"
#include "ui/workspace/key_images.h"
#include "ui/workspace/presented_frame.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

void paintContours(QPainter& painter, const ContourLines& contours, double pixelRatio) {
  constexpr double arm = 3;  // of a cross, logical pixels
  painter.setBrush(Qt::NoBrush);
  // A dark rim keeps them apart from bone.
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

// Empty: places of it are comparable with nothing else.
std::string SliceView::frameOfReferenceShown() const {
  const ShownSeriesPtr shown = this->shown();
  return shown && shown->volume->geometry().calibrated ? shown->series.frameOfReferenceUid : std::string();
}

std::vector<SegmentLayer> SliceView::segmentLayers() const {
  std::vector<SegmentLayer> layers;
  const std::string frame = frameOfReferenceShown();
  for (const auto& [key, look] : session_.workspace().regions) {
    if (look.kind != ReferenceKind::segmentation || frame.empty() || look.frameOfReferenceUid != frame)
      continue;
    const auto regions = references_.regions(key, look.kind);
    if (!regions || !regions->segmentation) continue;
    SegmentLayer layer{regions->segmentation, {}, look.opacity};
    for (std::size_t n = 0; n < regions->segmentation->segments.size(); ++n) {
      const Segment& segment = regions->segmentation->segments[n];
      if (look.shows(segment.number))
        layer.shown.push_back({n, regionColour(segment.colour, segment.number).rgb()});
    }
    layers.push_back(std::move(layer));
  }
  return layers;
}

// What lies over the picture: contours, and what a presentation state draws.
void SliceView::paintReferences(QPainter& painter) const {
  const double ratio = devicePixelRatioF();
  const SlicePlane now = *plane();
  const FlatLook look = flatLookOf(state());
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.scale(1 / ratio, 1 / ratio);
  const VoxelGeometry& acquired = seriesState().series->acquired;
  for (const auto& [key, regions] : session_.workspace().regions) {
    if (regions.kind != ReferenceKind::contours) continue;
    const auto loaded = references_.regions(key, regions.kind);
    if (!loaded || !loaded->contours) continue;
    const double reachMm = wheelStep(acquired, now.normal()) / 2;
    for (const ContourLines& lines :
         contourLines(*loaded->contours, regions, frameOfReferenceShown(), now, reachMm))
      paintContours(painter, lines, ratio);
  }
  painter.restore();
  if (!showsFrames() || !frame_->how || !look.layers) return;
  painter.save();
  const Overlays corners = overlays();
  const PlacedOverlays placed = placeOverlays(corners, overlayArea(), painter.font());
  std::vector<QRectF> taken = corners.taken;
  for (const PlacedText& text : placed.texts) taken.push_back(text.rect);
  if (!placed.scaleBar.isEmpty()) taken.push_back(placed.scaleBar);
  paintGraphics(
      painter, *frame_->how,
      [&](glm::dvec2 position, AnnotationUnits units) {
        const glm::dvec2 p = now.pixelFromPatient(annotationPlace(*frame_, position, units)) / ratio;
        return QPointF(p.x, p.y);
      },
      std::move(taken));
  painter.restore();
}

PictureSeen SliceView::pictureSeen() const {
  if (showsFrames()) return {frame_ ? std::optional(frame_->key.index) : std::nullopt, false};
  const ShownSeriesPtr shown = series();
  return shown ? volumen::pictureSeen(shown->series, shown->volume->geometry(), *plane()) : PictureSeen();
}

// What is to be said of the picture beside its own facts.
QStringList SliceView::referenceTexts() const {
  QStringList texts;
  const std::optional<int> picture = pictureSeen().index;
  const Series& series = *seriesState().series;
  if (showsFrames() && frame_->how) {
    const auto states = references_.naming(ReferenceKind::presentation, series, frame_->key.index);
    const ReferenceKey chosen = flatLookOf(state()).presentation;
    const auto is = [&](const ReferencePtr& object) { return keyOf(*object) == chosen; };
    const auto found = std::ranges::find_if(states, is);
    const QString label = found == states.end() ? QString() : shownText((*found)->label);
    texts << (label.isEmpty() ? tr("Presentation state") : tr("Presentation %1").arg(label));
  }
  if (!picture) return texts;
  const std::optional<KeyImage> image = keyImageOf(series, *picture);
  const bool isOfDocument = !references_.naming(ReferenceKind::keyObjects, series, *picture).empty();
  if (isOfDocument || (image && isKeyImage(session_.workspace(), *image)))
    texts << QStringLiteral("\u2605 ") + tr("Key image");
  return texts;
}

}  // namespace volumen
