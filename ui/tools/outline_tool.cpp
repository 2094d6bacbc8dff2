#include <cmath>
#include <utility>

#include "ui/controller/segment_editing.h"
#include "ui/tools/tool.h"

namespace volumen {

namespace {

constexpr double outlinePixels = 3;  // logical, between two points of a drag
constexpr std::size_t fewestCorners = 3;

using OutlinePoints = std::vector<glm::dvec3>;

// Draws an outline by one drag, or point by point with the last point at the pointer.
class OutlineDrag : public Drag {
 public:
  OutlineDrag(const SlicePress& press, std::function<void(const OutlinePoints&)> done)
      : press_(press), done_(std::move(done)) {
    drawn_.id = -1 - press.view;  // not an id of the workspace
    drawn_.series = keyOf(press.series->series);
    drawn_.shape.kind = ShapeKind::freehand;
    drawn_.shape.frame = press.frame;
    if (!press.frame)
      drawn_.shape.plane = ShapePlane{press.plane.centre, press.plane.right, press.plane.down};
    addPoint(press.at);
    addPoint(press.at);
  }

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    setLast(p);
    const QPointF way = p - places_[places_.size() - 2];
    if (isDrag_ && std::hypot(way.x(), way.y()) >= outlinePixels) addPoint(p);
  }

  void press(QPointF p) override {
    setLast(p);
    addPoint(p);
  }

  bool release(QPointF p, Qt::KeyboardModifiers keys) override {
    moveTo(p, keys);
    const bool isClick = points().size() == 2;
    if (isDrag_ && !isClick) return finish();
    isDrag_ = false;
    return false;
  }

  bool finish() override {
    points().pop_back();
    if (points().size() >= fewestCorners) done_(points());
    return true;
  }

  // All other keys are consumed so that the plane stays. Backspace removes the last point.
  bool takesKey(int key) override {
    if (key == Qt::Key_Backspace && !isDrag_ && points().size() > 2) {
      points().erase(points().end() - 2);
      places_.erase(places_.end() - 2);
    }
    return key != Qt::Key_Escape && key != Qt::Key_Return && key != Qt::Key_Enter;
  }

  const Measurement* drawing() const override { return &drawn_; }
  bool isMeasured() const override { return false; }

 private:
  OutlinePoints& points() { return drawn_.shape.points; }

  void addPoint(QPointF p) {
    points().push_back(press_.shapePointAt(p));
    places_.push_back(p);
  }

  void setLast(QPointF p) {
    points().back() = press_.shapePointAt(p);
    places_.back() = p;
  }

  const SlicePress press_;
  const std::function<void(const OutlinePoints&)> done_;
  Measurement drawn_;
  std::vector<QPointF> places_;  // positions of the points in the view
  bool isDrag_ = true;           // whether the button of the first press is held
};

// Ctrl at the start of the outline erases.
void paintInside(const SlicePress& drawnIn, OutlinePoints points) {
  const SlicePress press = ofPainted(drawnIn);
  SegmentStroke stroke = strokeOf(press);
  if (!stroke.onFrame) {
    for (glm::dvec3& p : points) p = press.plane.patientFromPixel(drawnIn.plane.pixelFromPatient(p));
    stroke.spans = insideOutline(press.series->volume->geometry(), points, press.plane.normal());
  }
  press.segments->paintAll(stroke);
}

}  // namespace

std::unique_ptr<Drag> drawOutline(const SlicePress& press,
                                  std::function<void(const std::vector<glm::dvec3>& points)> done) {
  return std::make_unique<OutlineDrag>(press, std::move(done));
}

std::unique_ptr<Drag> beginOutline(const SlicePress& press) {
  if (!press.segments) return nullptr;
  return drawOutline(press, [press](const OutlinePoints& points) { paintInside(press, points); });
}

}  // namespace volumen
