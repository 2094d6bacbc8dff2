#include "ui/views/reference_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "results/pictures/readable_text.h"
#include "ui/views/cross_lines.h"
#include "ui/workspace/links.h"

namespace volumen {

namespace {

constexpr double nameGap = 4;          // between a name and its line, logical pixels
constexpr double roomBesideName = 40;  // least length of a line with a name

// Returns the transform from the space of the other view into this one's, if there is one.
std::optional<Rigid> wayTo(const Workspace& workspace, ViewId view, ViewId other) {
  const Series *own = seriesIn(workspace, view), *its = seriesIn(workspace, other);
  if (!own || !its) return {};
  const auto relation = relationOf(workspace, frameOfReference(*its), frameOfReference(*own));
  return relation ? std::optional(relation->toFromFrom) : std::nullopt;
}

QRgb lineColourOf(ViewKind kind, const SlicePlane& plane) {
  if (showsSlices(kind)) return rowOf(kind).plane->lineColour;
  const Crosshair straight;
  const KindPlane* closest = nullptr;
  double cosine = -1;
  for (const KindRow& row : viewKinds()) {
    if (!row.plane) continue;
    const double now = std::abs(glm::dot(straight.plane(row.kind).normal(), plane.normal()));
    if (now > cosine) cosine = now, closest = &*row.plane;
  }
  return closest->lineColour;
}

// Places the name at the lower end of the line, on the side inside the view.
QRectF placeOfName(const ReferenceLine& line, QSizeF size, QRectF view) {
  const QPointF end = line.line.p1().y() > line.line.p2().y() ? line.line.p1() : line.line.p2();
  QRectF place(end + QPointF(nameGap, -nameGap - size.height()), size);
  if (place.right() > view.right()) place.moveRight(end.x() - nameGap);
  if (place.top() < view.top()) place.moveTop(view.top() + nameGap);
  return place;
}

}  // namespace

std::vector<FlatView::StackPlane> FlatView::stackPlanesIn(const Workspace& workspace, bool ends) const {
  const LoadedSeriesPtr shown = this->shown();
  const ViewState& view = workspace.view(id());
  const bool isHere = shown && view.series == state().series && view.kind == state().kind;
  if (!isHere || !shown->volume->geometry().calibrated) return {};
  const Stack now = stack(),
              its = &workspace == &session_.workspace() ? now : stackIn(workspace, id(), shown);
  // The plane of another frame is not known, as only the frame on screen was read.
  if (showsFrames(view.kind) && its.place.index != now.place.index) return {};
  std::vector<StackPlane> planes{{StackPart::current, planeShown(fittedPlane(workspace, pixels()))}};
  if (!ends || !its.toEnds) return planes;
  for (const auto& [part, way] :
       {std::pair(StackPart::first, its.toEnds->first), {StackPart::last, its.toEnds->second}}) {
    planes.push_back({part, planes.front().plane});
    planes.back().plane.centre += way;
  }
  return planes;
}

std::vector<ReferenceLine> FlatView::referenceLines() const {
  const Preferences& wanted = session_.preferences();
  const Workspace& workspace = session_.workspace();
  std::vector<ReferenceLine> lines;
  if (!wanted.referenceLines || stackPlanesIn(workspace, false).empty()) return lines;
  const SlicePlane own = *plane();
  const double ratio = devicePixelRatioF();
  for (const ViewId other : viewsOnScreen(workspace)) {
    const FlatView* view = other == id() || isCrossed(workspace, id(), other) ? nullptr : find_(other);
    const std::optional<Rigid> way = view ? wayTo(workspace, id(), other) : std::nullopt;
    if (!way) continue;
    const ViewKind kind = workspace.view(other).kind;
    for (const StackPlane& its : view->stackPlanesIn(workspace, wanted.referenceEnds)) {
      const auto segment = referenceSegment(own, carriedTo(*way, its.plane));
      if (!segment) continue;
      const QLineF line(segment->from.x / ratio, segment->from.y / ratio, segment->to.x / ratio,
                        segment->to.y / ratio);
      lines.push_back({other, its.part, line, lineColourOf(kind, its.plane),
                       its.part == StackPart::current ? tr(rowOf(kind).text) : QString()});
    }
  }
  return lines;
}

void paintReferenceLines(QPainter& painter, const std::vector<ReferenceLine>& lines, QRect view) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  std::vector<QRectF> taken;
  for (const ReferenceLine& line : lines) {
    const bool isCurrent = line.part == FlatView::StackPart::current;
    painter.setPen(QPen(QColor(line.colour), 1, isCurrent ? Qt::DashLine : Qt::DotLine));
    painter.drawLine(line.line);
    const QSizeF size = QFontMetricsF(painter.font()).size(Qt::TextSingleLine, line.name);
    const QRectF place = placeOfName(line, size, view);
    const auto meets = [&](QRectF other) { return other.intersects(place); };
    if (line.name.isEmpty() || line.line.length() < size.width() + roomBesideName ||
        !QRectF(view).contains(place) || std::ranges::any_of(taken, meets))
      continue;
    paintReadable(painter, place, Qt::AlignCenter, line.name, QColor(line.colour));
    taken.push_back(place);
  }
  painter.restore();
}

}  // namespace volumen
