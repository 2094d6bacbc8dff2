#include "ui/views/cross_lines.h"

#include <QLineF>
#include <algorithm>

#include "ui/workspace/flat_plane.h"

namespace volumen {

namespace {

// Logical pixels.
constexpr int middleGap = 20;         // gap about the crosshair's point
constexpr int freeAround = 24;        // distance from that point in which lines do not react
constexpr double handleRadius = 4;    // as drawn
constexpr double turnReach = 9;       // from a press
constexpr double moveReach = 4;       // from a press
constexpr double handleShare = 0.32;  // of the view's shorter side, measured from the crosshair's point

QPointF middleOf(const SlicePress& press) {
  return press.pixelAt(crosshairOf(press.session.workspace(), press.view, *press.series).at);
}

QSizeF pictureSizeOf(const SlicePress& press) {
  return {press.plane.size.x / press.pixelRatio, press.plane.size.y / press.pixelRatio};
}

double distance(QPointF a, QPointF b) { return QLineF(a, b).length(); }

// Returns the distance of a point from an infinite line.
double distanceFromLine(const CrossLine& line, QPointF p) {
  const QPointF along = line.to - line.from, from = p - line.from;
  return std::abs(along.x() * from.y() - along.y() * from.x()) / distance(line.from, line.to);
}

bool isOnHandle(const CrossLine& line, QPointF p) {
  return std::ranges::any_of(line.handles, [&](QPointF h) { return distance(h, p) <= turnReach; });
}

bool isWithin(QPointF p, QPointF middle, double reach) {
  return std::abs(p.x() - middle.x()) <= reach && std::abs(p.y() - middle.y()) <= reach;
}

bool isInMiddleThird(const SlicePress& press) {
  const QSizeF size = pictureSizeOf(press);
  return std::abs(press.at.x() - size.width() / 2) < size.width() / 6 &&
         std::abs(press.at.y() - size.height() / 2) < size.height() / 6;
}

const CrossLine* lineAt(const std::vector<CrossLine>& lines, const SlicePress& press, bool whole) {
  const QPointF middle = middleOf(press);
  if (isWithin(press.at, middle, whole ? middleGap : freeAround)) return nullptr;
  if (!whole && isInMiddleThird(press)) return nullptr;
  const auto line = std::ranges::find_if(
      lines, [&](const CrossLine& l) { return distanceFromLine(l, press.at) <= moveReach; });
  return line == lines.end() ? nullptr : &*line;
}

}  // namespace

bool isCrossed(const Workspace& workspace, ViewId view, ViewId other) {
  const ViewState &own = workspace.view(view), &its = workspace.view(other);
  return view != other && showsSlices(own.kind) && showsSlices(its.kind) && own.series == its.series &&
         !scrollsAlone(workspace, view);
}

std::vector<CrossLine> crossLines(const SlicePress& press) {
  if (!press.session.preferences().crosshairLines) return {};
  const Workspace& workspace = press.session.workspace();
  const Crosshair crosshair = crosshairOf(workspace, press.view, *press.series);
  const QPointF middle = middleOf(press);
  const QSizeF size = pictureSizeOf(press);
  const QRectF within = QRectF({0, 0}, size).adjusted(10, 10, -10, -10);
  std::vector<CrossLine> lines;
  for (const ViewId other : viewsOnScreen(workspace)) {
    if (!isCrossed(workspace, press.view, other)) continue;
    const ViewState& view = workspace.view(other);
    const SlicePlane plane =
        flatPlane(view, flatLookOf(view), press.series->volume->geometry(), crosshair, {100, 100});
    const auto cut = referenceLine(press.plane, plane);
    if (!cut) continue;
    const auto logical = [&](glm::dvec2 p) { return QPointF(p.x, p.y) / press.pixelRatio; };
    CrossLine line{view.kind, logical(cut->from), logical(cut->to), {}};
    const QPointF along = (line.to - line.from) / distance(line.from, line.to);
    for (const double sign : {-1.0, 1.0}) {
      const QPointF handle = middle + sign * handleShare * std::min(size.width(), size.height()) * along;
      if (within.contains(handle) && within.contains(middle)) line.handles.push_back(handle);
    }
    lines.push_back(line);
  }
  return lines;
}

void paintCrossLines(QPainter& painter, const std::vector<CrossLine>& lines, QPointF middle, QRect view) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const QRect free(middle.toPoint() - QPoint(middleGap, middleGap), QSize(2 * middleGap, 2 * middleGap));
  painter.setClipRegion(QRegion(view) - QRegion(free));
  for (const CrossLine& line : lines) {
    painter.setPen(QPen(QColor(QRgb(rowOf(line.kind).plane->lineColour)), 1));
    painter.drawLine(line.from, line.to);
    painter.setBrush(Qt::black);
    for (const QPointF handle : line.handles) painter.drawEllipse(handle, handleRadius, handleRadius);
  }
  painter.restore();
}

bool isOnLines(const SlicePress& press, bool whole) {
  const std::vector<CrossLine> lines = crossLines(press);
  const auto onHandle = [&](const CrossLine& line) { return isOnHandle(line, press.at); };
  return std::ranges::any_of(lines, onHandle) || lineAt(lines, press, whole);
}

std::unique_ptr<Drag> beginOnLines(const SlicePress& press, bool whole) {
  const std::vector<CrossLine> lines = crossLines(press);
  for (const CrossLine& line : lines)
    if (isOnHandle(line, press.at)) return beginTurn(press);
  const CrossLine* line = lineAt(lines, press, whole);
  if (!line) return nullptr;
  const QPointF along = (line->to - line->from) / distance(line->from, line->to);
  return beginMovePlane(press, {-along.y(), along.x()});
}

}  // namespace volumen
