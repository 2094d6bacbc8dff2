#include <algorithm>
#include <cmath>

#include "results/text/text.h"
#include "ui/tools/tool.h"
#include "ui/workspace/measurements.h"

namespace volumen {

namespace {

constexpr double clickOnSurface = 3;  // logical pixels; shorter movements are clicks, not drags

// Draws a shape point by point on the surface seen. The last point follows the pointer and waits where no
// surface is seen. Released away from the point before, it stays, so one drag or two clicks make a line.
class SurfaceShapeDrag : public SceneDrag {
 public:
  SurfaceShapeDrag(const ScenePress& press, ShapeKind kind) : press_(press), rule_(ruleOf(kind)) {
    drawn_.id = -1 - press.view;  // not an id of the workspace
    drawn_.series = keyOf(press.series->series);
    drawn_.shape.kind = kind;
    points_ = {*press.surfaceAt(press.at), *press.surfaceAt(press.at)};
    placed_ = press.at;
    putPoints();
  }

  void moveTo(QPointF p, Qt::KeyboardModifiers) override { follow(p); }
  void press(QPointF p) override { follow(p); }

  bool release(QPointF p, Qt::KeyboardModifiers) override {
    const bool isOnSurface = follow(p);
    if (std::hypot(p.x() - placed_.x(), p.y() - placed_.y()) < clickOnSurface) return false;
    if (!isOnSurface) return press_.missed(p), false;
    if (points_.size() == rule_.most) {
      addMeasurement(press_.session, drawn_.series, drawn_.shape);
      return true;
    }
    points_.push_back(points_.back());
    placed_ = p;
    putPoints();
    return false;
  }

  const Measurement* drawing() const override { return &drawn_; }
  bool goesOnIn(const SeriesKey& shown) const override { return shown == drawn_.series; }

 private:
  bool follow(QPointF p) {
    const std::optional<SurfacePoint> at = press_.surfaceAt(p);
    if (at) points_.back() = *at;
    putPoints();
    return at.has_value();
  }

  void putPoints() {
    double softest = 0;
    drawn_.shape.points.clear();
    for (const SurfacePoint& point : points_) {
      drawn_.shape.points.push_back(point.pPatient);
      softest = std::max(softest, point.softMm);
    }
    drawn_.shape.softMm = softest;
  }

  const ScenePress press_;
  const ShapeRule& rule_;
  Measurement drawn_;
  std::vector<SurfacePoint> points_;
  QPointF placed_;  // position of the last but one point
};

// Moves a point of a measurement over the surface seen, by the movement of the pointer. A click moves
// nothing.
class SurfacePointDrag : public SceneDrag {
 public:
  SurfacePointDrag(const ScenePress& press, int measurement, std::size_t point, QPointF seenAt)
      : press_(press),
        atPress_(*findMeasurement(press.session.workspace(), measurement)),
        point_(point),
        fromPress_(seenAt - press.at) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    moved_ = moved_ || std::hypot(p.x() - press_.at.x(), p.y() - press_.at.y()) >= clickOnSurface;
    if (!moved_) return;
    const std::optional<SurfacePoint> at = press_.surfaceAt(p + fromPress_);
    if (!at) return;
    editMeasurement(press_.session, atPress_.id, tr("Change measurement"), [&](Measurement& m) {
      m.shape = withHandleAt(atPress_.shape, point_, at->pPatient);
      m.shape.softMm = std::max(atPress_.shape.softMm.value_or(0), at->softMm);
    });
  }
  bool goesOnIn(const SeriesKey& shown) const override { return shown == keyOf(press_.series->series); }

 private:
  const ScenePress press_;
  const Measurement atPress_;
  const std::size_t point_;
  const QPointF fromPress_;
  bool moved_ = false;
};

}  // namespace

std::unique_ptr<SceneDrag> beginSurfaceShape(const ScenePress& press, ShapeKind kind) {
  if (!press.surfaceAt(press.at)) return press.missed(press.at), nullptr;
  return std::make_unique<SurfaceShapeDrag>(press, kind);
}

std::unique_ptr<SceneDrag> beginSurfacePoint(const ScenePress& press, int measurement, std::size_t point,
                                             QPointF seenAt) {
  return std::make_unique<SurfacePointDrag>(press, measurement, point, seenAt);
}

}  // namespace volumen
