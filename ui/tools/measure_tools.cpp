#include <QCoreApplication>
#include <cmath>
#include <glm/geometric.hpp>

#include "results/text/text.h"
#include "ui/tools/tool.h"
#include "ui/workspace/measurement_text.h"
#include "ui/workspace/measurements.h"
#include "ui/workspace/spine_labels.h"

namespace volumen {

namespace {

constexpr double clickPixels = 3;     // logical; shorter movements are clicks, not drags
constexpr double freehandPixels = 3;  // logical, between two points of an outline

// Draws a shape point by point. The last point follows the pointer until it is released away from the point
// before, so one drag or two clicks make a line. In shapes of two lines, the second line starts with its own
// press.
class ShapeDrag : public Drag {
 public:
  ShapeDrag(const SlicePress& press, ShapeKind kind) : press_(press), rule_(ruleOf(kind)) {
    drawn_.id = -1 - press.view;  // not an id of the workspace
    drawn_.series = keyOf(press.series->series);
    drawn_.shape.kind = kind;
    drawn_.shape.frame = press.frame;
    if (rule_.region)
      drawn_.shape.plane =
          press.frame ? ShapePlane{} : ShapePlane{press.plane.centre, press.plane.right, press.plane.down};
    if (kind == ShapeKind::label) drawn_.shape.name = nextLabel(press.session.workspace(), drawn_.series);
    beginLine(press.at);
  }

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    if (!following_) return;
    setLast(p);
    if (rule_.kind == ShapeKind::freehand && points().size() < rule_.most && lastSegment() >= freehandPixels)
      addPoint(p);
  }

  void press(QPointF p) override { following_ ? moveTo(p, {}) : beginLine(p); }

  bool release(QPointF p, Qt::KeyboardModifiers) override {
    moveTo(p, {});
    if (rule_.kind == ShapeKind::freehand) return points().size() < rule_.fewest || complete();
    if (rule_.most > 1 && lastSegment() < clickPixels) return false;
    if (points().size() == rule_.most) return complete();
    following_ = !rule_.twoLines;
    if (following_) addPoint(places_.back());
    return false;
  }

  bool finish() override {
    if (rule_.kind != ShapeKind::polyline && rule_.kind != ShapeKind::openCurve) return false;
    points().pop_back();
    places_.pop_back();
    return points().size() < rule_.fewest || complete();
  }

  const Measurement* drawing() const override { return &drawn_; }
  bool scrolls() const override { return rule_.acrossSlices && !press_.frame; }
  void planeChanged(const SlicePlane& plane) override { press_.plane = plane; }

 private:
  std::vector<glm::dvec3>& points() { return drawn_.shape.points; }

  // Adds both ends of a line; the second follows the pointer.
  void beginLine(QPointF p) {
    addPoint(p);
    if (rule_.most > 1) addPoint(p);
    following_ = true;
  }

  void addPoint(QPointF p) {
    points().push_back(press_.shapePointAt(p));
    places_.push_back(p);
  }

  void setLast(QPointF p) {
    p = constrained(p);
    points().back() = press_.shapePointAt(p);
    places_.back() = p;
  }

  // Constrains the last point: a short axis is perpendicular to the long one, widths of a chest are
  // horizontal.
  QPointF constrained(QPointF p) const {
    if (rule_.kind == ShapeKind::cardiothoracic) return {p.x(), places_[places_.size() - 2].y()};
    if (rule_.kind != ShapeKind::bidirectional || places_.size() < 4) return p;
    const QPointF along = places_[1] - places_[0], across(-along.y(), along.x()), from = places_[2];
    return from + across * (QPointF::dotProduct(p - from, across) / QPointF::dotProduct(across, across));
  }

  // Returns the length of the last segment in logical pixels; across slices it is the distance in space.
  double lastSegment() const {
    const std::vector<glm::dvec3>& p = drawn_.shape.points;
    if (scrolls())
      return glm::distance(p[p.size() - 2], p.back()) / (press_.plane.mmPerPixel * press_.pixelRatio);
    const QPointF way = places_.back() - places_[places_.size() - 2];
    return std::hypot(way.x(), way.y());
  }

  bool complete() {
    press_.session.endGesture();
    addMeasurement(press_.session, drawn_.series, drawn_.shape);
    return true;
  }

  SlicePress press_;
  const ShapeRule& rule_;
  Measurement drawn_;
  std::vector<QPointF> places_;  // positions of the points in the view
  bool following_ = false;       // whether the last point follows the pointer
};

template <ShapeKind kind>
std::unique_ptr<Drag> beginShape(const SlicePress& press) {
  return std::make_unique<ShapeDrag>(press, kind);
}

template <ShapeKind kind>
std::unique_ptr<SceneDrag> beginShapeInScene(const ScenePress& press) {
  return beginSurfaceShape(press, kind);
}

template <ShapeKind kind>
Tool measuringTool(int key, const QString& otherWords = {}) {
  return {.name = ruleOf(kind).name,
          .text = kindText(kind),
          .cursor = Qt::CrossCursor,
          .inSlices = beginShape<kind>,
          .inScene = ruleOf(kind).inScene ? beginShapeInScene<kind> : nullptr,
          .key = key,
          .measuring = true,
          .otherWords = otherWords};
}

Tool labelTool() {
  Tool tool = measuringTool<ShapeKind::label>(0);
  tool.text = tr("Spine labels");
  tool.stays = true;
  return tool;
}

}  // namespace

std::vector<Tool> measuringTools() {
  using enum ShapeKind;
  return {measuringTool<length>(Qt::Key_D, tr("distance ruler caliper measure line")),
          measuringTool<polyline>(0),
          measuringTool<openCurve>(0),
          measuringTool<bidirectional>(0, tr("RECIST diameter bidimensional")),
          measuringTool<angle>(Qt::Key_A),
          measuringTool<cobb>(0),
          measuringTool<legAxis>(0),
          measuringTool<cardiothoracic>(0),
          measuringTool<ellipse>(Qt::Key_E, tr("ROI region of interest mean SUV HU")),
          measuringTool<rectangle>(0),
          measuringTool<freehand>(0),
          measuringTool<probe>(Qt::Key_P, tr("value point HU SUV")),
          measuringTool<arrow>(Qt::Key_T, tr("annotate annotation text note")),
          labelTool()};
}

}  // namespace volumen
