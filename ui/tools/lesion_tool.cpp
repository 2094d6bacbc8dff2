#include <QPainter>
#include <QPainterPath>
#include <cmath>
#include <glm/geometric.hpp>

#include "ui/tools/tool.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

constexpr double leastBallPixels = 3;  // logical; a smaller sphere is a click
const QColor ballColour(0xff, 0xd5, 0x4f);

// The surface of the sphere passes through the pointer, in any slice.
class LesionDrag : public Drag {
 public:
  explicit LesionDrag(const SlicePress& press)
      : press_(press), plane_(press.plane), pMiddle_(press.patientAt(press.at)) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    reach(p);
    tell(isBall() ? DrawnBall::State::drawing : DrawnBall::State::givenUp);
  }

  bool release(QPointF p, Qt::KeyboardModifiers) override {
    reach(p);
    tell(isBall() ? DrawnBall::State::done : DrawnBall::State::givenUp);
    return true;
  }

  void giveUp() override { tell(DrawnBall::State::givenUp); }
  bool scrolls() const override { return true; }
  void planeChanged(const SlicePlane& plane) override { plane_ = plane; }
  bool drawsOver() const override { return true; }

 private:
  bool isBall() const { return radiusMm_ >= leastBallPixels * press_.pixelRatio * plane_.mmPerPixel; }
  void reach(QPointF p) {
    const glm::dvec2 pixel = glm::dvec2(p.x(), p.y()) * press_.pixelRatio;
    radiusMm_ = glm::distance(pMiddle_, plane_.patientFromPixel(pixel));
  }
  void tell(DrawnBall::State state) const {
    if (press_.takeBall)
      press_.takeBall({keyOf(press_.series->series), pMiddle_, radiusMm_, state, press_.frame.has_value()});
  }

  const SlicePress press_;
  SlicePlane plane_;  // the plane shown, in device pixels
  const glm::dvec3 pMiddle_;
  double radiusMm_ = 0;
};

}  // namespace

void paintBall(QPainter& painter, const SlicePlane& plane, double pixelRatio, glm::dvec3 pMiddle,
               double radiusMm) {
  const double away = glm::dot(pMiddle - plane.centre, plane.normal());
  if (std::abs(away) >= radiusMm) return;
  const glm::dvec2 at = plane.pixelFromPatient(pMiddle) / pixelRatio;
  const double radius = std::sqrt(radiusMm * radiusMm - away * away) / plane.mmPerPixel / pixelRatio;
  QPainterPath circle, text;
  circle.addEllipse(QPointF(at.x, at.y), radius, radius);
  text.addText(at.x + 0.75 * radius + 6, at.y + 0.75 * radius + 6, painter.font(),
               tr("r %1 mm").arg(radiusMm, 0, 'f', 1));
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const QPainterPath& path : {circle, text}) painter.strokePath(path, QPen(QColor(0, 0, 0, 150), 3));
  painter.strokePath(circle, QPen(ballColour, 1.4));
  painter.fillPath(text, ballColour);
  painter.restore();
}

std::unique_ptr<Drag> beginLesion(const SlicePress& press) { return std::make_unique<LesionDrag>(press); }

}  // namespace volumen
