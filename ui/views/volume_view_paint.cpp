#include <QPainter>
#include <QToolButton>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "results/text/series_text.h"
#include "results/text/text.h"
#include "results/text/value_text.h"
#include "ui/overlays/view_overlays.h"
#include "ui/views/cine_bar.h"
#include "ui/views/volume_view.h"
#include "ui/widgets/orientation_cube.h"
#include "ui/widgets/warning_badge.h"
#include "ui/workspace/corner_text.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/windows.h"
#include "viewer/scene/modes.h"

namespace volumen {

QString VolumeView::textAt(QPointF position) const {
  if (const QString measured = measurementText(position); !measured.isEmpty()) return measured;
  const std::optional<Pick> hit = pickAt(position);
  if (!hit) return {};
  const LoadedSeriesPtr shown = series();
  QString text = valueText(*shown, hit->value);
  if (hit->segment)
    text = tr("%1: %2").arg(shownText(scenes_.segments(id())[*hit->segment].segment->label), text);
  if (!hit->pPatient)
    return tr("%1 %2 along the line of sight").arg(QLatin1String(rowOf(scene().mode).ofLine), text);
  if (!shown->volume->geometry().calibrated) return text;
  return text + tr(" at %1").arg(placeText(shown->series, *hit->pPatient));
}

// Texts stand above the bar of time points.
QRectF VolumeView::overlayArea() const {
  return QRectF(rect()).adjusted(0, 0, 0, cine_->isHidden() ? 0 : -CineBar::barHeight);
}

Overlays VolumeView::overlays() const {
  const LoadedSeriesPtr shown = series();
  const Camera seen = camera();
  Overlays o = viewOverlays(*shown, seen, size());
  o.topLeft = seriesCorner(shown->series).left(cornerLines(overlayArea(), font()));
  o.bottomRight = caption_;
  o.date = dateBeside();
  for (const QWidget* child : std::initializer_list<const QWidget*>{cube_, badge_, showTable_})
    if (child->isVisibleTo(this)) o.taken.push_back(child->geometry());
  QStringList more{stepText(session_.workspace(), state().series)};
  more << lossyText(shown->series) << maskTexts(session_.maskOf(state().series));
  if (const TissueLeft::Entry* tissue = scenes_.tissue(id()))
    more << tissueText(tissue->key.shown)
         << (tissue->value->patient && isDrawn_ ? tr("table not shown") : QString());
  if (scene().mode != Mode::composite && !scenes_.segments(id()).empty())
    more << tr("no segments in projections");
  more.removeAll(QString());
  const QString zoomText = tr("Zoom %1 %").arg(std::lround(100 * zoom()));
  if (scene().mode != Mode::composite) o.topRight << windowText(windowInUse(scene(), *shown), shown->series);
  o.topRight << zoomText;
  if (seen.projection == Projection::perspective) o.topRight << tr("Perspective");
  o.topRight << more;
  return o;
}

bool VolumeView::planesOnScreen() const {
  const Workspace& workspace = session_.workspace();
  return series() && std::ranges::any_of(viewsOnScreen(workspace), [&](ViewId other) {
           const ViewState& view = workspace.view(other);
           const auto shown = workspace.series.find(view.series);
           return isFlat(view.kind) && shown != workspace.series.end() &&
                  frameOfReference(*shown->second.series) == frameOfReference(series()->series);
         });
}

std::optional<QPointF> VolumeView::seenAtPlace(const Camera& camera, glm::dvec3 pPatient) const {
  const SightLine middle = sightLine(camera, size(), size() / 2.0);
  if (camera.projection == Projection::perspective &&
      glm::dot(pPatient - middle.origin, middle.direction) <= 0)
    return {};
  const glm::dvec2 p = seenAt(camera, size(), pPatient);
  return QPointF(p.x, p.y);
}

// Paints where the planes on screen meet.
void VolumeView::paintCrosshair(QPainter& painter) const {
  if (!planesOnScreen()) return;
  constexpr double gap = 4, arm = 11;  // logical pixels
  const Camera seen = camera();
  const glm::dvec3 at = crosshairOf(session_.workspace(), *series()).at;
  const std::optional<QPointF> p = seenAtPlace(seen, at);
  if (!p) return;
  for (const auto& [colour, width] :
       {std::pair(QColor(Qt::black), 3.0), std::pair(QColor(0xf5, 0xd9, 0x4a), 1.0)}) {
    painter.setPen(QPen(colour, width));
    for (const QPointF d : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
      painter.drawLine(*p + gap * d, *p + arm * d);
  }
}

// Many of them are painted once and kept as a picture: cursors move below them at every step of a wheel.
void VolumeView::paintMeasured(QPainter& painter) const {
  constexpr std::size_t few = 16;
  const auto placed = placedMeasurements();
  painter.save();
  if (placed->size() <= few) {
    paintMeasurements(painter, *placed);
  } else {
    if (painted_.size() != pixels() || painted_.devicePixelRatio() != devicePixelRatioF()) {
      painted_ = QImage(pixels(), QImage::Format_ARGB32_Premultiplied);
      painted_.setDevicePixelRatio(devicePixelRatioF());
      painted_.fill(Qt::transparent);
      QPainter over(&painted_);
      over.setFont(painter.font());
      paintMeasurements(over, *placed);
    }
    painter.drawImage(QPointF(0, 0), painted_);
  }
  painter.restore();
}

std::vector<QWidget*> VolumeView::badges() const {
  std::vector<QWidget*> all = View::badges();
  all.push_back(cube_);
  all.push_back(showTable_);
  all.push_back(badge_);
  return all;
}

void VolumeView::paintCanvas(QPainter& painter) const {
  painter.setFont(font());  // style sheets do not pass it on to the canvas
  paintShown(painter);
  if (series() || isWaiting()) paintFocus(painter);
}

void VolumeView::paintShown(QPainter& painter) const {
  painter.fillRect(rect(), QColor(0x10, 0x12, 0x14));
  if (!series() && !isWaiting()) return;
  if (const QImage& picture = shown(); !picture.isNull()) {
    const QSizeF shown = picture.deviceIndependentSize();
    if (picture.size() == pixels()) {
      painter.drawImage(QPointF(0, 0), picture);
    } else {
      // During a resize of the window the last picture stays until the next one arrives.
      const double scale = height() / shown.height();
      const QSizeF fitted = shown * scale;
      painter.setRenderHint(QPainter::SmoothPixmapTransform);
      painter.drawImage(QRectF(QPointF((width() - fitted.width()) / 2, 0), fitted), picture);
    }
  }
  if (!series()) {
    return paintOverlays(painter, waitingOverlays(), overlayArea());
  }
  Overlays over = overlays();
  if (errorShown_) over.topRight << errorImage_.legend;
  paintCrosshair(painter);
  paintMeasured(painter);
  if (drag_ && drag_->drawsOver()) drag_->paint(painter, QWidget::size());
  paintOverlays(painter, over, overlayArea());
}

}  // namespace volumen
