#include <QLineF>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "results/pictures/readable_text.h"
#include "ui/views/drawn_measurement.h"

namespace volumen {

namespace {

const QColor lineColour(0xff, 0xbf, 0x69), accent(0x4a, 0xa3, 0xff), shadow(0, 0, 0, 190);
constexpr double lineWidth = 1.3, shadowWidth = 3.4;  // logical pixels
constexpr double crossArm = 7, crossGap = 2.5, head = 11,
                 corner = 4;       // of a probe's cross, an arrow, a handle
constexpr double longestGap = 18;  // between a shape and its text without a leader line

QColor colourOf(const DrawnMeasurement& d) { return d.selected ? accent : lineColour; }

void addCross(QPainterPath& path, QPointF at) {
  for (const QPointF way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)}) {
    path.moveTo(at + crossGap * way);
    path.lineTo(at + crossArm * way);
  }
}

void addArrowHead(QPainterPath& path, QPointF tip, QPointF end) {
  const double length = std::hypot(end.x() - tip.x(), end.y() - tip.y());
  if (length < 1) return;
  const QPointF back = (end - tip) / length * head, side(-back.y() * 0.4, back.x() * 0.4);
  path.moveTo(tip + back + side);
  path.lineTo(tip);
  path.lineTo(tip + back - side);
}

// A small arc at the vertex shows which lines belong together.
void addArc(QPainterPath& path, const QPolygonF& arms) {
  const QLineF first(arms[1], arms[0]), second(arms[1], arms[2]);
  const double radius = std::min({18.0, first.length() / 2, second.length() / 2});
  if (radius < 4) return;
  const QRectF circle(arms[1] - QPointF(radius, radius), QSizeF(2 * radius, 2 * radius));
  double sweep = second.angle() - first.angle();
  if (sweep > 180) sweep -= 360;
  if (sweep < -180) sweep += 360;
  path.arcMoveTo(circle, first.angle());
  path.arcTo(circle, first.angle(), sweep);
}

QPainterPath pathOf(const DrawnMeasurement& d) {
  QPainterPath path;
  for (const QPolygonF& line : d.lines) {
    if (line.size() == 1)
      addCross(path, line.front());
    else
      path.addPolygon(line);
    if (!d.whole)
      for (const QPointF end : {line.front(), line.back()}) path.addEllipse(end, 1.5, 1.5);
  }
  if (d.kind == ShapeKind::arrow && d.whole) addArrowHead(path, d.lines[0][0], d.lines[0][1]);
  if (d.kind == ShapeKind::angle && d.whole && d.lines[0].size() == 3) addArc(path, d.lines[0]);
  return path;
}

void stroke(QPainter& painter, const QPainterPath& path, const QColor& colour) {
  painter.strokePath(path, QPen(shadow, shadowWidth, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
  painter.strokePath(path, QPen(colour, lineWidth, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
}

void strokeDashes(QPainter& painter, const QPainterPath& path, const QColor& colour) {
  QPen pen(colour, 1, Qt::CustomDashLine, Qt::FlatCap);
  pen.setDashPattern({3, 4});
  painter.strokePath(path, QPen(QColor(0, 0, 0, 110), 2.4, Qt::SolidLine, Qt::FlatCap));
  painter.strokePath(path, pen);
}

// Paints leader lines from distant texts to the nearest point of the shape, and between the lines of a Cobb
// angle.
void paintLeaders(QPainter& painter, const DrawnMeasurement& d) {
  QPainterPath path;
  if (d.kind == ShapeKind::cobb && d.whole && d.lines.size() == 2) {
    path.moveTo((d.lines[0][0] + d.lines[0][1]) / 2);
    path.lineTo((d.lines[1][0] + d.lines[1][1]) / 2);
  }
  if (!d.textRect.isEmpty()) {
    const auto nearest = [&](QPointF p) {
      return QPointF(std::clamp(p.x(), d.textRect.left(), d.textRect.right()),
                     std::clamp(p.y(), d.textRect.top(), d.textRect.bottom()));
    };
    QLineF leader(d.middle, nearest(d.middle));
    for (const QPolygonF& line : d.lines)
      for (const QPointF p : line)
        if (const QLineF other(p, nearest(p)); other.length() < leader.length()) leader = other;
    if (leader.length() > longestGap) {
      path.moveTo(leader.p1());
      path.lineTo(leader.p2());
    }
  }
  if (!path.isEmpty()) strokeDashes(painter, path, colourOf(d));
}

void paintText(QPainter& painter, const DrawnMeasurement& d) {
  if (!d.legend.isEmpty())
    paintReadable(painter, d.legendRect.topLeft() + QPointF(2, 0), d.legend, colourOf(d));
  if (d.textRect.isEmpty()) return;
  const QFontMetricsF metrics(painter.font());
  QPointF place = d.textRect.topLeft() + QPointF(2, 2);
  for (const QString& line : d.letter.isEmpty() ? d.text : QStringList(d.letter)) {
    paintReadable(painter, place, line, colourOf(d));
    place.ry() += metrics.height();
  }
}

void paintHandles(QPainter& painter, const DrawnMeasurement& d) {
  for (const DrawnMeasurement::Handle& handle : d.handles) {
    painter.setPen(QPen(accent, lineWidth));
    painter.setBrush(QColor(0, 0, 0, 150));
    painter.drawEllipse(handle.at, corner, corner);
  }
  painter.setBrush(Qt::NoBrush);
}

}  // namespace

void paintMeasurements(QPainter& painter, const std::vector<DrawnMeasurement>& drawn) {
  painter.setRenderHint(QPainter::Antialiasing);
  for (const DrawnMeasurement& d : drawn) {
    paintLeaders(painter, d);
    stroke(painter, pathOf(d), colourOf(d));
    paintHandles(painter, d);
  }
  for (const DrawnMeasurement& d : drawn) paintText(painter, d);
}

}  // namespace volumen
