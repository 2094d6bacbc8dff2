#include <QPainter>
#include <cmath>

#include "ui/views/drawn_measurement.h"
#include "ui/views/slice_view.h"
#include "ui/views/view_overlays.h"
#include "ui/widgets/warning_badge.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/text.h"
#include "ui/workspace/windows.h"

namespace volumen {

namespace {

constexpr int crossGap = 20;  // logical pixels left free about the crosshair's middle

// The colour of a view's line in the others.
QColor lineColour(ViewKind kind) {
  switch (kind) {
    case ViewKind::axial:
      return QColor(0xff, 0x5c, 0x5c);
    case ViewKind::coronal:
      return QColor(0x5c, 0xe0, 0x7a);
    default:
      return QColor(0xf5, 0xd9, 0x4a);
  }
}

QString kindText(ViewKind kind) {
  return kind == ViewKind::coronal    ? SliceView::tr("Coronal")
         : kind == ViewKind::sagittal ? SliceView::tr("Sagittal")
                                      : SliceView::tr("Axial");
}

QString slabText(const FlatLook& look) {
  const char* mode = look.slabMode == SlabMode::max   ? "MIP"
                     : look.slabMode == SlabMode::min ? "MinIP"
                                                      : "Mean";
  return QStringLiteral("%1 %2 mm").arg(QLatin1String(mode)).arg(look.slabMm, 0, 'f', 1);
}

// "S 12.5 mm": where along its axis a plane lies.
QString positionText(ViewKind kind, glm::dvec3 p) {
  const auto [mm, plus, minus] = kind == ViewKind::coronal    ? std::tuple(p.y, "P", "A")
                                 : kind == ViewKind::sagittal ? std::tuple(p.x, "L", "R")
                                                              : std::tuple(p.z, "S", "I");
  return QStringLiteral("%1 %2 mm").arg(QLatin1String(mm < 0 ? minus : plus)).arg(std::abs(mm), 0, 'f', 1);
}

}  // namespace

QString SliceView::hoverText(QPointF position) const {
  const auto press = pressAt(position);
  if (!press) return {};
  const Volume& volume = *press->series->volume;
  const glm::dvec3 p = press->patientAt(position);
  const glm::ivec3 voxel(glm::floor(volume.geometry().voxelFromPatient(p) + 0.5));
  if (glm::any(glm::lessThan(voxel, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(voxel, volume.size())))
    return {};
  const QString text = QString::number(volume.value(voxel.x, voxel.y, voxel.z), 'f',
                                       valueDecimals(press->series->histogram) - 1) +
                       unitSuffix(press->series->series);
  return volume.geometry().calibrated ? text + tr(" at %1").arg(placeText(p)) : text;
}

Overlays SliceView::overlays() const {
  const ShownSeriesPtr shown = series();
  const VoxelGeometry& geometry = shown->volume->geometry();
  const SlicePlane now = *plane();
  const FlatLook look = flatLookOf(state());
  const glm::dvec3 cursor = cursorOf(session_.workspace(), *shown);
  const StackPlace place = stackPlace(geometry, state().kind, cursor);
  const Window window = flatWindow(session_.workspace().series.at(keyOf(shown->series)), *shown);
  Overlays o;
  o.topLeft << patientText(shown->series) << seriesText(shown->series);
  o.topLeft.removeAll(QString());
  o.topRight << kindText(state().kind) << QStringLiteral("%1 / %2").arg(place.index + 1).arg(place.count);
  o.bottomRight = tr("W %1 L %2").arg(std::abs(window.width), 0, 'g', 4).arg(window.centre, 0, 'g', 4);
  if (badge_->isVisibleTo(this)) o.taken.push_back(badge_->geometry());
  if (!geometry.calibrated) return o;
  o.topRight << positionText(state().kind, now.centre);
  if (look.slabMm > 0) o.topRight << slabText(look);
  const auto letters = [](glm::dvec3 d) { return QString::fromStdString(sideLetters(d)); };
  o.right = letters(now.right);
  o.left = letters(-now.right);
  o.bottom = letters(now.down);
  o.top = letters(-now.down);
  o.mmPerPixel = now.mmPerPixel * devicePixelRatioF();
  return o;
}

// Where the other planes on screen cut this one, with a gap at the cursor.
void SliceView::paintLines(QPainter& painter) const {
  const SlicePlane now = *plane();
  const double ratio = devicePixelRatioF();
  const auto logical = [&](glm::dvec2 p) { return QPointF(p.x / ratio, p.y / ratio); };
  const ShownSeriesPtr shown = series();
  const glm::dvec3 cursor = cursorOf(session_.workspace(), *shown);
  const QPointF middle = logical(now.pixelFromPatient(cursor));
  QRegion clip(rect());
  clip -= QRegion(QRect(middle.toPoint() - QPoint(crossGap, crossGap), QSize(2 * crossGap, 2 * crossGap)));
  painter.save();
  painter.setClipRegion(clip);
  painter.setRenderHint(QPainter::Antialiasing);
  for (const ViewId other : viewsOnScreen(session_.workspace())) {
    const ViewState& view = session_.workspace().view(other);
    if (other == id() || view.kind == ViewKind::volume || view.series != state().series) continue;
    const SlicePlane plane = flatPlane(view, flatLookOf(view), shown->volume->geometry(), cursor, {100, 100});
    const auto line = referenceLine(now, plane);
    if (!line) continue;
    painter.setPen(QPen(lineColour(view.kind), 1));
    painter.drawLine(logical(line->from), logical(line->to));
  }
  painter.restore();
}

void SliceView::paintStackBar(QPainter& painter) const {
  const ShownSeriesPtr shown = series();
  const StackPlace place =
      stackPlace(shown->volume->geometry(), state().kind, cursorOf(session_.workspace(), *shown));
  const QRectF bar(width() - 5.0, 0, 3, height());
  const double part = bar.height() / place.count;
  painter.fillRect(bar, QColor(255, 255, 255, 30));
  painter.fillRect(QRectF(bar.x(), place.index * part, bar.width(), std::max(3.0, part)),
                   QColor(255, 255, 255, 140));
}

void SliceView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Qt::black);
  if (series()) {
    if (!picture_.isNull()) painter.drawImage(QPointF(0, 0), picture_);
    paintLines(painter);
    paintMeasurements(painter, drawnMeasurements());
    paintOverlays(painter, overlays(), overlayArea());
    paintStackBar(painter);
  }
  paintFocus(painter);
}

}  // namespace volumen
