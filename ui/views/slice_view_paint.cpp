#include <QPainter>
#include <cmath>

#include "ui/overlays/view_overlays.h"
#include "ui/views/clip_lines.h"
#include "ui/views/colour_bar.h"
#include "ui/views/cross_lines.h"
#include "ui/views/drawn_measurement.h"
#include "ui/views/slice_view.h"
#include "ui/views/time_bar.h"
#include "ui/widgets/warning_badge.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/corner_text.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/series_text.h"
#include "ui/workspace/text.h"
#include "ui/workspace/value_text.h"
#include "ui/workspace/windows.h"

namespace volumen {

namespace {

// The value of the voxel at a point, with its unit; empty outside the volume.
QString valueAt(const ShownSeries& shown, glm::dvec3 p) {
  const Volume& volume = *shown.volume;
  const glm::ivec3 voxel(glm::floor(volume.geometry().voxelFromPatient(p) + 0.5));
  if (glm::any(glm::lessThan(voxel, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(voxel, volume.size())))
    return {};
  return valueText(shown, volume.value(voxel.x, voxel.y, voxel.z));
}

}  // namespace

QString SliceView::hoverText(QPointF position) const {
  const auto press = pressAt(position);
  if (!press) return {};
  if (showsFrames()) return frameHoverText(position);
  const glm::dvec3 p = press->patientAt(position);
  QString text = valueAt(*press->series, p);
  if (text.isEmpty()) return {};
  if (const ShownSeriesPtr over = session_.seriesNamed(flatLookOf(state()).overlay)) {
    const auto relation = relationOf(session_.workspace(), frameOfReference(press->series->series),
                                     frameOfReference(over->series));
    const QString second = relation ? valueAt(*over, relation->toFromFrom(p)) : QString();
    if (!second.isEmpty()) text += QStringLiteral(" | ") + second;
  }
  return press->series->volume->geometry().calibrated
             ? text + tr(" at %1").arg(placeText(press->series->series, p))
             : text;
}

Overlays SliceView::overlays() const {
  if (showsFrames()) return frameOverlays();
  const ShownSeriesPtr shown = series();
  const SlicePlane now = *plane();
  const Workspace& workspace = session_.workspace();
  const FlatLook look = flatLookOf(state());
  const Window window = flatWindow(seriesState(), *shown);
  CornerTexts texts = slicesCorner(workspace, id(), *shown, now);
  if (const ShownSeriesPtr over = session_.seriesNamed(look.overlay))
    texts.add(CornerItem::overlay,
              tr("with %1, %2 %").arg(seriesText(over->series)).arg(std::lround(100 * look.overlayOpacity)));
  texts.add(CornerItem::mark, referenceTexts());
  const int lines = cornerLines(overlayArea(), font());
  Overlays o;
  o.topLeft = texts.left(lines);
  o.topRight = texts.right(lines);
  o.bottomRight = windowText(window, shown->series);
  if (badge_->isVisibleTo(this)) o.taken.push_back(badge_->geometry());
  if (!shown->volume->geometry().calibrated) return o;
  const auto letters = [known = knowsSides(shown->series)](glm::dvec3 d) {
    return known ? QString::fromStdString(sideLetters(d)) : QString();
  };
  o.right = letters(now.right);
  o.left = letters(-now.right);
  o.bottom = letters(now.down);
  o.top = letters(-now.down);
  o.mmPerPixel = now.mmPerPixel * devicePixelRatioF();
  return o;
}

// At the bottom; what is written stands above it.
void SliceView::placeTimeBar() {
  constexpr int height = 20;
  time_->setGeometry(8, this->height() - height, width() - 20, height);
}

QRectF SliceView::overlayArea() const {
  return QRectF(rect()).adjusted(0, 0, -6, time_->hasSteps() ? -time_->height() : 0);
}

void SliceView::paintStackBar(QPainter& painter) const {
  const StackPlace place = this->place();
  if (place.count < 2) return;
  const QRectF bar(width() - 5.0, 0, 3, height());
  const double part = bar.height() / place.count;
  painter.fillRect(bar, QColor(255, 255, 255, 30));
  painter.fillRect(QRectF(bar.x(), place.index * part, bar.width(), std::max(3.0, part)),
                   QColor(255, 255, 255, 140));
}

// The bar of what is shown in colours: the overlay, else the series.
void SliceView::paintColours(QPainter& painter) const {
  const FlatLook look = flatLookOf(state());
  const auto& all = session_.workspace().series;
  if (const ShownSeriesPtr over = session_.seriesNamed(look.overlay))
    return paintColourBar(painter, rect(), look.overlayColours,
                          shownWindow(overlayWindow(all.at(look.overlay), *over), over->series),
                          unitSuffix(over->series));
  const SeriesState& own = all.at(state().series);
  if (own.colours != ColourMap::grey)
    paintColourBar(painter, rect(), own.colours, shownWindow(flatWindow(own, *series()), series()->series),
                   unitSuffix(series()->series));
}

void SliceView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Qt::black);
  if (shown()) {
    if (!picture_.isNull()) painter.drawImage(QPointF(0, 0), picture_);
    paintReferences(painter);
    if (!showsFrames()) {
      const SlicePress here = *pressAt({});
      paintClipLines(painter, clipLines(here, clipShown_));
      paintCrossLines(painter, crossLines(here),
                      here.pixelAt(crosshairOf(session_.workspace(), id(), *series()).at), rect());
    }
    paintMeasurements(painter, drawnMeasurements());
    paintOverlays(painter, overlays(), overlayArea());
    paintStackBar(painter);
    if (!showsFrames()) paintColours(painter);
  } else if (isWaiting()) {
    painter.drawImage(QPointF(0, 0), picture_);
    paintOverlays(painter, waitingOverlays(), overlayArea());
  } else if (!frameFailure_.isEmpty()) {
    Overlays only;
    only.warning = frameFailure_;
    paintOverlays(painter, only, rect());
  }
  paintFocus(painter);
}

}  // namespace volumen
