#include "ui/workspace/measurements.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "results/text/text.h"
#include "ui/workspace/measurement_text.h"
#include "ui/workspace/time_points.h"
#include "viewer/measure/outline.h"
#include "viewer/measure/shape_cut.h"

namespace volumen {

namespace {

constexpr std::size_t mostHandles = 12;

bool isBox(const Shape& shape) {
  return shape.kind == ShapeKind::ellipse || shape.kind == ShapeKind::rectangle;
}

glm::dvec3 footOn(const ShapePlane& plane, glm::dvec3 p) {
  return p - plane.normal() * glm::dot(p - plane.centre, plane.normal());
}

// Returns the number of points of a freehand outline from one handle to the next.
std::size_t strideOf(const Shape& shape) { return (shape.points.size() + mostHandles - 1) / mostHandles; }

void dragOutline(std::vector<glm::dvec3>& points, std::size_t at, std::size_t stride, glm::dvec3 mm) {
  const auto count = std::ptrdiff_t(points.size()), reach = std::ptrdiff_t(stride);
  for (std::ptrdiff_t n = 1 - reach; n < reach; ++n) {
    const double part = 1 - double(std::abs(n)) / double(reach);
    points[std::size_t((std::ptrdiff_t(at) + n + count) % count)] += part * mm;
  }
}

// Returns a vector without its component along a unit vector.
glm::dvec3 acrossOf(glm::dvec3 way, glm::dvec3 along) { return way - along * glm::dot(way, along); }

// The other end of the line follows perpendicular to the line.
void dragLevelLine(std::vector<glm::dvec3>& p, std::size_t handle, glm::dvec3 place) {
  const std::size_t other = handle ^ 1u;
  const glm::dvec3 line = p[other] - p[handle], way = place - p[handle];
  if (glm::length(line) > 0) p[other] += acrossOf(way, glm::normalize(line));
  p[handle] = place;
}

// The short axis keeps its length, its relative position on the long one, and its right angle to it.
void dragLongAxis(std::vector<glm::dvec3>& p, std::size_t handle, glm::dvec3 place) {
  const std::vector<glm::dvec3> was = p;
  const glm::dvec3 fixed = p[handle ^ 1u], before = p[handle] - fixed, after = place - fixed;
  if (glm::length(after) == 0) return;
  p[handle] = place;
  if (glm::length(before) == 0) return;
  const glm::dvec3 u = glm::normalize(before), normal = glm::cross(before, was[3] - was[2]);
  if (glm::length(normal) == 0) return;
  const glm::dvec3 now = glm::normalize(after), across = glm::cross(glm::normalize(normal), u),
                   acrossNow = glm::normalize(glm::cross(normal, now));
  for (const std::size_t n : {2u, 3u}) {
    const glm::dvec3 from = was[n] - fixed;
    p[n] = fixed + after * (glm::dot(from, u) / glm::length(before)) + acrossNow * glm::dot(from, across);
  }
}

// The other end follows only along the long axis.
void dragShortAxis(std::vector<glm::dvec3>& p, std::size_t handle, glm::dvec3 place) {
  const glm::dvec3 line = p[1] - p[0];
  if (glm::length(line) == 0) return;
  const glm::dvec3 along = glm::normalize(line);
  p[handle ^ 1u] += along * glm::dot(place - p[handle], along);
  p[handle] = place;
}

void dragTwoLines(Shape& shape, std::size_t handle, glm::dvec3 place, glm::dvec3 unit) {
  for (glm::dvec3& p : shape.points) p *= unit;
  const auto drag = shape.kind == ShapeKind::cardiothoracic ? dragLevelLine
                    : handle < 2                            ? dragLongAxis
                                                            : dragShortAxis;
  drag(shape.points, handle, place * unit);
  for (glm::dvec3& p : shape.points) p /= unit;
}

}  // namespace

const Measurement* findMeasurement(const Workspace& workspace, int id) {
  const auto found = std::ranges::find(workspace.measurements, id, &Measurement::id);
  return found == workspace.measurements.end() ? nullptr : &*found;
}

std::vector<const Measurement*> measurementsIn(const Workspace& workspace, const std::string& frame) {
  std::vector<const Measurement*> found;
  for (const Measurement& m : workspace.measurements) {
    const auto state = workspace.series.find(m.series);
    if (!m.shape.frame && state != workspace.series.end() && frameOfReference(*state->second.series) == frame)
      found.push_back(&m);
  }
  return found;
}

std::vector<const Measurement*> measurementsOn(const Workspace& workspace, const Series& series, int frame) {
  std::vector<const Measurement*> found;
  for (const Measurement& m : workspace.measurements)
    if (m.shape.frame && m.series == keyOf(series) && frameMeant(series, *m.shape.frame) == frame)
      found.push_back(&m);
  return found;
}

int addMeasurement(Session& session, const SeriesKey& series, const Shape& shape) {
  addMeasurements(session, series, {&shape, 1});
  return session.workspace().selected;
}

void addMeasurements(Session& session, const SeriesKey& series, std::span<const Shape> shapes) {
  if (shapes.empty() || !session.workspace().series.contains(series)) return;
  const QString text = shapes.size() == 1 ? kindText(shapes[0].kind) : tr("Add measurements");
  session.change(text, [&](Workspace& w) {
    int last = 0;
    for (const Measurement& m : w.measurements) last = std::max(last, m.id);
    for (const Shape& shape : shapes) w.measurements.push_back({++last, series, shape, {}});
    w.selected = last;
    w.measurementsShown = true;
  });
}

void editMeasurement(Session& session, int id, const QString& text,
                     const std::function<void(Measurement&)>& change) {
  session.change(
      text,
      [&](Workspace& w) { w.measurements.editIf([id](const Measurement& m) { return m.id == id; }, change); },
      text + QString::number(id));
}

bool isToBeNamed(const Workspace& workspace, const Measurement& made) {
  if (made.shape.kind != ShapeKind::label) return made.shape.kind == ShapeKind::arrow;
  const auto isLabel = [&](const Measurement& m) {
    return m.shape.kind == ShapeKind::label && m.series == made.series;
  };
  return made.shape.name.empty() || std::ranges::count_if(workspace.measurements, isLabel) == 1;
}

void renameMeasurement(Session& session, int id, const QString& name) {
  session.endGesture();
  editMeasurement(session, id, tr("Rename measurement"),
                  [&](Measurement& m) { m.shape.name = name.simplified().toStdString(); });
}

void deleteMeasurement(Session& session, int id) {
  session.change(tr("Delete measurement"), [&](Workspace& w) {
    w.measurements.eraseIf([&](const Measurement& m) { return m.id == id; });
    if (w.selected == id) w.selected = 0;
  });
}

void deleteAllMeasurements(Session& session) {
  session.change(tr("Delete all measurements"), [](Workspace& w) {
    w.measurements.clear();
    w.selected = 0;
  });
}

void showMeasurements(Session& session, bool shown) {
  session.change(shown ? tr("Show measurements") : tr("Hide measurements"),
                 [&](Workspace& w) { w.measurementsShown = shown; });
}

Shape movedBy(Shape shape, glm::dvec3 way) {
  for (glm::dvec3& p : shape.points) p += way;
  if (shape.plane && !shape.frame) shape.plane->centre += way;
  return shape;
}

std::vector<glm::dvec3> handlesOf(const Shape& shape) {
  if (shape.kind == ShapeKind::ellipse) {
    Shape box = shape;
    box.kind = ShapeKind::rectangle;
    return edgeOf(box);
  }
  if (shape.kind == ShapeKind::rectangle) return edgeOf(shape);
  if (shape.kind != ShapeKind::freehand) return shape.points;
  std::vector<glm::dvec3> handles;
  for (std::size_t n = 0; n < shape.points.size(); n += strideOf(shape)) handles.push_back(shape.points[n]);
  return handles;
}

Shape withHandleAt(Shape shape, std::size_t handle, glm::dvec3 place, glm::dvec3 unit) {
  const std::vector<glm::dvec3> handles = handlesOf(shape);
  if (handle >= handles.size()) return shape;
  if (shape.plane) place = footOn(*shape.plane, place);
  if (isBox(shape))
    shape.points = {handles[(handle + 2) % 4], place};
  else if (shape.kind == ShapeKind::freehand)
    dragOutline(shape.points, handle * strideOf(shape), strideOf(shape), place - handles[handle]);
  else if (shape.kind == ShapeKind::bidirectional || shape.kind == ShapeKind::cardiothoracic)
    dragTwoLines(shape, handle, place, unit);
  else
    shape.points[handle] = place;
  return shape;
}

std::vector<ChartKind> chartsOf(const Workspace& workspace, const Measurement& measurement) {
  const Shape& shape = measurement.shape;
  if (shape.kind == ShapeKind::length || shape.kind == ShapeKind::polyline) return {ChartKind::profile};
  if (!ruleOf(shape.kind).region) return {};
  std::vector<ChartKind> kinds{ChartKind::histogram};
  if (!shape.frame && hasTimePoints(workspace, measurement.series)) kinds.push_back(ChartKind::overTime);
  return kinds;
}

}  // namespace volumen
