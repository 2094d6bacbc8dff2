#include "ui/views/drawn_measurement.h"

#include <QLineF>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "ui/views/rect_index.h"
#include "ui/workspace/measurements.h"
#include "viewer/measure/shape_cut.h"

namespace volumen {

namespace {

// Logical pixels.
constexpr double handleReach = 7, lineReach = 5, markReach = 8;
constexpr double textGaps[] = {8, 40, 90, 150};  // distances of a text from its shape, tried in order
constexpr double textFrame = 2;                  // margin about the letters
constexpr double anyDistance = 1e9;              // mm

double squared(QPointF p) { return QPointF::dotProduct(p, p); }

double distanceTo(QPointF a, QPointF b, QPointF p) {
  const QPointF along = b - a;
  const double t = squared(along) == 0 ? 0 : QPointF::dotProduct(p - a, along) / squared(along);
  return std::sqrt(squared(p - (a + std::clamp(t, 0.0, 1.0) * along)));
}

double distanceTo(const QPolygonF& line, QPointF p) {
  double least = std::sqrt(squared(p - line.front()));
  for (qsizetype n = 1; n < line.size(); ++n) least = std::min(least, distanceTo(line[n - 1], line[n], p));
  return least;
}

// Returns whether a line crosses or lies in a rectangle.
bool touches(const QPolygonF& line, const QRectF& rect) {
  if (rect.contains(line.front())) return true;
  const QPointF corners[] = {rect.topLeft(), rect.topRight(), rect.bottomRight(), rect.bottomLeft()};
  for (qsizetype n = 1; n < line.size(); ++n) {
    if (rect.contains(line[n])) return true;
    for (int c = 0; c < 4; ++c)
      if (QLineF(line[n - 1], line[n]).intersects({corners[c], corners[(c + 1) % 4]}, nullptr) ==
          QLineF::BoundedIntersection)
        return true;
  }
  return false;
}

QRectF boxOf(const DrawnMeasurement& drawn) {
  QRectF box;
  for (const QPolygonF& line : drawn.lines)
    for (const QPointF p : line) {
      const QRectF around(p - QPointF(markReach, markReach) / 2, QSizeF(markReach, markReach));
      box = box.isNull() ? around : box.united(around);
    }
  return box;
}

// Returns whether a text would cover the shape, including the inside of regions. `box` is the box of the
// shape.
bool coversShape(const DrawnMeasurement& drawn, const QRectF& box, const QRectF& text) {
  if (!box.intersects(text)) return false;
  return (drawn.whole && ruleOf(drawn.kind).region) ||
         std::ranges::any_of(drawn.lines, [&](const QPolygonF& line) { return touches(line, text); });
}

// Returns centres of positions beside a box: right, left, below, above. Each side has its middle, then its
// ends, then the corners.
std::vector<QPointF> middlesBeside(const QRectF& box, QSizeF size, double gap) {
  const double dx = box.width() / 2 + gap + size.width() / 2,
               dy = box.height() / 2 + gap / 2 + size.height() / 2;
  const double alongX = (size.width() - box.width()) / 2, alongY = (size.height() - box.height()) / 2;
  std::vector<QPointF> middles;
  for (const double end : {0.0, 1.0, -1.0})
    for (const QPointF way : {QPointF(dx, end * alongY), QPointF(-dx, end * alongY),
                              QPointF(end * alongX, dy), QPointF(end * alongX, -dy)})
      middles.push_back(box.center() + way);
  for (const QPointF way : {QPointF(dx, dy), QPointF(dx, -dy), QPointF(-dx, dy), QPointF(-dx, -dy)})
    middles.push_back(box.center() + way);
  return middles;
}

QRectF around(QPointF middle, QSizeF size) {
  return {middle - QPointF(size.width(), size.height()) / 2, size};
}

QRectF movedInto(QRectF rect, const QRectF& area) {
  rect.moveLeft(std::clamp(rect.left(), area.left(), std::max(area.left(), area.right() - rect.width())));
  rect.moveTop(std::clamp(rect.top(), area.top(), std::max(area.top(), area.bottom() - rect.height())));
  return rect;
}

// Returns positions for a text inside `area`, best first. Lines have them at their last end, then at their
// first end; all shapes have them beside their visible box. Empty if nothing of the shape is visible.
std::vector<QRectF> placesFor(const DrawnMeasurement& drawn, const QRectF& box, QSizeF size,
                              const QRectF& area) {
  std::vector<QRectF> boxes;
  if (!ruleOf(drawn.kind).region)
    for (const QPointF end : {drawn.lines.back().back(), drawn.lines.front().front()})
      boxes.emplace_back(end - QPointF(2, 2), QSizeF(4, 4));
  boxes.push_back(box);
  std::vector<QRectF> places;
  for (const double gap : textGaps)
    for (const QRectF& beside : boxes) {
      if (!area.intersects(beside)) continue;
      for (const QPointF middle : middlesBeside(beside.intersected(area), size, gap))
        places.push_back(movedInto(around(middle, size), area));
    }
  return places;
}

QSizeF sizeOf(const QStringList& text, const QFontMetricsF& metrics) {
  double width = 0;
  for (const QString& line : text) width = std::max(width, metrics.horizontalAdvance(line));
  return {std::ceil(width) + 2 * textFrame, double(text.size()) * metrics.height() + 2 * textFrame};
}

// Returns the text drawn at the shape: the letter if there is a legend.
QStringList besideShape(const DrawnMeasurement& drawn) {
  return drawn.letter.isEmpty() ? drawn.text : QStringList(drawn.letter);
}

// Returns positions all over the area, row by row.
std::vector<QRectF> placesAllOver(QSizeF size, const QRectF& area) {
  constexpr double across = 16, down = 8;
  std::vector<QRectF> places;
  for (double y = area.top(); y + size.height() <= area.bottom(); y += down)
    for (double x = area.left(); x + size.width() <= area.right(); x += across)
      places.emplace_back(QPointF(x, y), size);
  return places;
}

// Finds room beside shapes for their texts.
class TextRoom {
 public:
  TextRoom(const std::vector<DrawnMeasurement>& drawn, const QRectF& area, const std::vector<QRectF>& taken)
      : drawn_(drawn), area_(area), texts_(area), shapes_(area) {
    for (const QRectF& rect : taken) take(rect);
    for (std::size_t n = 0; n < drawn.size(); ++n) {
      if (!drawn[n].legendRect.isEmpty()) take(drawn[n].legendRect);
      boxes_.push_back(boxOf(drawn[n]));
      shapes_.add(boxes_[n], n);
    }
  }

  void take(const QRectF& text) { texts_.add(text, 0); }

  // Returns the best place for a text of shape `n`; none if nothing of the shape is in the area.
  std::optional<QRectF> placeOf(std::size_t n, QSizeF size) {
    const std::vector<QRectF> places = placesFor(drawn_[n], boxes_[n], size, area_);
    if (places.empty()) return {};
    const auto leavesIt = [&](const QRectF& place) { return !coversShape(drawn_[n], boxes_[n], place); };
    const auto leavesTexts = [&](const QRectF& place) { return !texts_.any(place) && leavesIt(place); };
    auto found = std::ranges::find_if(
        places, [&](const QRectF& p) { return leavesTexts(p) && leavesShapes(p, true); });
    if (found == places.end())
      found = std::ranges::find_if(places,
                                   [&](const QRectF& p) { return leavesTexts(p) && leavesShapes(p, false); });
    if (found == places.end()) found = std::ranges::find_if(places, leavesTexts);
    if (found == places.end())
      if (const auto anywhere = placeAnywhere(drawn_[n].middle, size, leavesIt)) return anywhere;
    if (found == places.end()) found = std::ranges::find_if(places, leavesIt);
    return found == places.end() ? places.front() : *found;
  }

 private:
  bool leavesShapes(const QRectF& place, bool cutsToo) const {
    return !shapes_.any(place, [&](std::size_t m) {
      return (cutsToo || drawn_[m].whole) && coversShape(drawn_[m], boxes_[m], place);
    });
  }

  // Returns the nearest free place to a point. Texts are only added, so if a smaller one found no room, this
  // one finds none.
  template <class LeavesIt>
  std::optional<QRectF> placeAnywhere(QPointF middle, QSizeF size, const LeavesIt& leavesIt) {
    const bool isFull = std::ranges::any_of(tooLarge_, [&](QSizeF least) {
      return least.width() <= size.width() && least.height() <= size.height();
    });
    if (isFull) return {};
    std::vector<QRectF> places = placesAllOver(size, area_);
    std::erase_if(places, [&](const QRectF& place) { return texts_.any(place); });
    if (places.empty()) tooLarge_.push_back(size);
    std::ranges::stable_sort(places, {}, [&](const QRectF& p) { return squared(p.center() - middle); });
    const auto free = std::ranges::find_if(places, leavesIt);
    return free == places.end() ? std::nullopt : std::optional(*free);
  }

  const std::vector<DrawnMeasurement>& drawn_;
  const QRectF area_;
  RectIndex texts_, shapes_;
  std::vector<QRectF> boxes_;     // of the shapes
  std::vector<QSizeF> tooLarge_;  // for which there is no room
};

// Returns A, B ... Z, AA, AB ...
QString letterOf(int n) {
  QString letters;
  for (++n; n > 0; n = (n - 1) / 26) letters.prepend(QChar(u'A' + (n - 1) % 26));
  return letters;
}

// Returns the lowest free position at the left edge, else at the right edge.
std::optional<QRectF> roomAtEdge(QSizeF size, const QRectF& area, const std::vector<QRectF>& taken) {
  constexpr double step = 4;
  for (const double x : {area.left(), area.right() - size.width()})
    for (double y = area.bottom() - size.height(); y >= area.top(); y -= step) {
      const QRectF place(QPointF(x, y), size);
      if (std::ranges::none_of(taken, [&](const QRectF& other) { return other.intersects(place); }))
        return place;
    }
  return {};
}

// Moves a measurement of a frame into the space of the slice that shows it.
Measurement inSlice(Measurement m, const VoxelGeometry& slice) {
  m.shape = inSliceSpace(m.shape, slice);
  if (m.textOffset) m.textOffset = slice.patientFromVoxelStep * *m.textOffset;
  return m;
}

}  // namespace

DrawnMeasurement drawnMeasurement(const Measurement& ofDocument, const SlicePlane& plane,
                                  const VoxelGeometry& geometry, double pixelRatio, bool selected) {
  const Measurement measurement = ofDocument.shape.frame ? inSlice(ofDocument, geometry) : ofDocument;
  DrawnMeasurement drawn;
  drawn.id = measurement.id;
  drawn.kind = measurement.shape.kind;
  drawn.selected = selected;
  const Shape& shape = measurement.shape;
  const auto pixel = [&](glm::dvec3 p) {
    const glm::dvec2 at = plane.pixelFromPatient(p) / pixelRatio;
    return QPointF(at.x, at.y);
  };
  const bool isAcross = ruleOf(shape.kind).acrossSlices;
  const double half = seenWithin(plane, geometry);
  // A measurement being drawn is visible from all slices.
  const ShapeCut cut = cutOf(shape, plane, isAcross && measurement.id < 0 ? anyDistance : half);
  drawn.whole = cut.whole;
  for (const std::vector<glm::dvec3>& line : cut.lines) {
    QPolygonF& points = drawn.lines.emplace_back();
    for (const glm::dvec3 p : line) points << pixel(p);
  }
  if (drawn.lines.empty()) return drawn;
  drawn.middle = pixel(middleOf(shape));
  if (measurement.textOffset) drawn.textMiddle = pixel(middleOf(shape) + *measurement.textOffset);
  if (!selected || (!cut.whole && !isAcross)) return drawn;
  const std::vector<glm::dvec3> handles = handlesOf(shape);
  for (std::size_t n = 0; n < handles.size(); ++n)
    if (cut.whole || std::abs(glm::dot(handles[n] - plane.centre, plane.normal())) <= half)
      drawn.handles.push_back({n, pixel(handles[n])});
  return drawn;
}

DrawnMeasurement drawnInScene(const Measurement& measurement,
                              const std::function<std::optional<QPointF>(glm::dvec3 pPatient)>& seenAt,
                              bool selected) {
  DrawnMeasurement drawn;
  const Shape& shape = measurement.shape;
  drawn.id = measurement.id;
  drawn.kind = shape.kind;
  drawn.whole = true;
  drawn.selected = selected;
  if (shape.frame || !ruleOf(shape.kind).inScene) return drawn;
  QPolygonF line;
  for (const glm::dvec3 p : shape.points) {
    const std::optional<QPointF> at = seenAt(p);
    if (!at) return drawn;
    if (selected) drawn.handles.push_back({std::size_t(line.size()), *at});
    line << *at;
  }
  drawn.middle = seenAt(middleOf(shape)).value_or(line.front());
  drawn.lines.push_back(std::move(line));
  return drawn;
}

void placeBeside(const Overlays& written, std::vector<DrawnMeasurement>& drawn, const QRectF& area,
                 const QFont& font) {
  if (drawn.empty()) return;
  const PlacedOverlays placed = placeOverlays(written, area, font);
  std::vector<QRectF> taken{placed.scaleBar};
  for (const PlacedText& text : placed.texts) taken.push_back(text.rect);
  const QRectF inside = area.adjusted(4, 4, -4, -4);
  placeLegend(drawn, inside, taken, QFontMetricsF(font));
  placeTexts(drawn, inside, taken, QFontMetricsF(font));
}

void placeLegend(std::vector<DrawnMeasurement>& drawn, const QRectF& area, const std::vector<QRectF>& taken,
                 const QFontMetricsF& metrics) {
  std::vector<DrawnMeasurement*> told;
  for (DrawnMeasurement& d : drawn)
    if (!d.text.isEmpty()) told.push_back(&d);
  if (told.size() < 2 || std::min(area.width(), area.height()) >= smallView) return;
  QStringList lines;
  for (int n = 0; n < int(told.size()); ++n)
    lines << metrics.elidedText(
        letterOf(n) + QStringLiteral("  ") + told[std::size_t(n)]->text.join(QStringLiteral(", ")),
        Qt::ElideRight, area.width() - 2 * textFrame);
  const auto place = roomAtEdge(sizeOf(lines, metrics), area, taken);
  if (!place) return;
  for (std::size_t n = 0; n < told.size(); ++n) {
    told[n]->letter = letterOf(int(n));
    told[n]->legend = lines[qsizetype(n)];
    told[n]->legendRect = {place->left(), place->top() + textFrame + double(n) * metrics.height(),
                           place->width(), metrics.height()};
  }
}

void placeTexts(std::vector<DrawnMeasurement>& drawn, const QRectF& area, const std::vector<QRectF>& taken,
                const QFontMetricsF& metrics) {
  TextRoom room(drawn, area, taken);
  for (DrawnMeasurement& d : drawn) {
    if (d.text.isEmpty() || !d.textMiddle) continue;
    d.textRect = around(*d.textMiddle, sizeOf(besideShape(d), metrics));
    room.take(d.textRect);
  }
  for (std::size_t n = 0; n < drawn.size(); ++n) {
    DrawnMeasurement& d = drawn[n];
    if (d.text.isEmpty() || d.textMiddle) continue;
    if (const auto place = room.placeOf(n, sizeOf(besideShape(d), metrics))) {
      d.textRect = *place;
      room.take(*place);
    }
  }
}

std::optional<DrawnHit> hitAt(const std::vector<DrawnMeasurement>& drawn, QPointF p) {
  for (auto d = drawn.rbegin(); d != drawn.rend(); ++d)
    for (const DrawnMeasurement::Handle& handle : d->handles)
      if (std::sqrt(squared(p - handle.at)) <= handleReach)
        return DrawnHit{&*d, MeasurementPart::handle, handle.index};
  for (auto d = drawn.rbegin(); d != drawn.rend(); ++d) {
    if (d->textRect.contains(p)) return DrawnHit{&*d, MeasurementPart::text};
    for (const QPolygonF& line : d->lines)
      if (distanceTo(line, p) <= (line.size() == 1 ? markReach : lineReach))
        return DrawnHit{&*d, MeasurementPart::line};
  }
  return {};
}

}  // namespace volumen
