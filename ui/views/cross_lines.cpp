#include "ui/views/cross_lines.h"

#include <QLineF>
#include <algorithm>

#include "ui/workspace/flat_plane.h"

namespace volumen {

namespace {

// Logical pixels.
constexpr int middleGap = 20;         // left free about the crosshair's point
constexpr double handleRadius = 4;    // as drawn
constexpr double turnReach = 9;       // for a press
constexpr double moveReach = 4;       // likewise
constexpr double handleShare = 0.36;  // of the view's shorter side, from the crosshair's point

QPointF middleOf(const SlicePress& press) {
  return press.pixelAt(crosshairOf(press.session.workspace(), press.view, *press.series).at);
}

double distance(QPointF a, QPointF b) { return QLineF(a, b).length(); }

// Of a point from a line that goes on without end.
double distanceFromLine(const CrossLine& line, QPointF p) {
  const QPointF along = line.to - line.from, from = p - line.from;
  return std::abs(along.x() * from.y() - along.y() * from.x()) / distance(line.from, line.to);
}

bool isOnHandle(const CrossLine& line, QPointF p) {
  return std::ranges::any_of(line.handles, [&](QPointF h) { return distance(h, p) <= turnReach; });
}

const CrossLine* lineAt(const std::vector<CrossLine>& lines, QPointF p, QPointF middle) {
  if (std::abs(p.x() - middle.x()) <= middleGap && std::abs(p.y() - middle.y()) <= middleGap) return nullptr;
  const auto line =
      std::ranges::find_if(lines, [&](const CrossLine& l) { return distanceFromLine(l, p) <= moveReach; });
  return line == lines.end() ? nullptr : &*line;
}

}  // namespace

std::vector<CrossLine> crossLines(const SlicePress& press) {
  const Workspace& workspace = press.session.workspace();
  const Crosshair crosshair = crosshairOf(workspace, press.view, *press.series);
  const QPointF middle = middleOf(press);
  const QSizeF size(press.plane.size.x / press.pixelRatio, press.plane.size.y / press.pixelRatio);
  const QRectF within = QRectF({0, 0}, size).adjusted(10, 10, -10, -10);
  std::vector<CrossLine> lines;
  for (const ViewId other : viewsOnScreen(workspace)) {
    const ViewState& view = workspace.view(other);
    if (other == press.view || !showsSlices(view.kind) || view.series != keyOf(press.series->series))
      continue;
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

bool isOnLines(const SlicePress& press) {
  const std::vector<CrossLine> lines = crossLines(press);
  const auto onHandle = [&](const CrossLine& line) { return isOnHandle(line, press.at); };
  return std::ranges::any_of(lines, onHandle) || lineAt(lines, press.at, middleOf(press));
}

std::unique_ptr<Drag> beginOnLines(const SlicePress& press) {
  const std::vector<CrossLine> lines = crossLines(press);
  for (const CrossLine& line : lines)
    if (isOnHandle(line, press.at)) return beginTurn(press);
  const CrossLine* line = lineAt(lines, press.at, middleOf(press));
  if (!line) return nullptr;
  const QPointF along = (line->to - line->from) / distance(line->from, line->to);
  return beginMovePlane(press, {-along.y(), along.x()});
}

}  // namespace volumen
