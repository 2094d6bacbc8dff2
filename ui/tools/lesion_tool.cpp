#include <QPainter>
#include <QPainterPath>
#include <cmath>
#include <glm/geometric.hpp>

#include "results/text/text.h"
#include "ui/controller/lesion.h"
#include "ui/controller/segment_editing.h"
#include "ui/tools/tool.h"
#include "ui/workspace/links.h"

namespace volumen {

namespace {

constexpr double leastBallPixels = 3;  // logical; a smaller sphere is a click
const QColor ballColour(0xff, 0xd5, 0x4f);

// Paints the intersection of a slice with a sphere, and its radius. `pMiddle` is in mm of the slice's patient
// space.
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

// Draws a sphere in which a lesion is searched, in all slices. Its surface passes through the pointer, in any
// slice.
class LesionDrag : public Drag {
 public:
  explicit LesionDrag(const SlicePress& press)
      : press_(press),
        plane_(press.plane),
        ball_{keyOf(press.series->series), press.patientAt(press.at), 0, press.frame.has_value()} {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    reach(p);
    if (isBall())
      press_.segments->preview(lesion());
    else
      press_.segments->endPreview();
  }

  bool release(QPointF p, Qt::KeyboardModifiers) override {
    reach(p);
    return finish();
  }

  bool finish() override {
    if (isBall())
      press_.segments->change(lesion());
    else
      press_.segments->endPreview();
    return true;
  }

  void giveUp() override { press_.segments->endPreview(); }
  bool scrolls() const override { return true; }
  void planeChanged(const SlicePlane& plane) override { plane_ = plane; }
  bool drawsOver() const override { return true; }
  bool drawsInAll() const override { return true; }

  // In another frame of reference the sphere is drawn where the registration puts it.
  void paintIn(QPainter& painter, const SlicePress& shown) const override {
    if (!isBall() || shown.frame) return;
    const auto relation = relationOf(press_.session.workspace(), frameOfReference(press_.series->series),
                                     frameOfReference(shown.series->series));
    if (relation)
      paintBall(painter, shown.plane, shown.pixelRatio, relation->toFromFrom(ball_.pPatient), ball_.radiusMm);
  }

 private:
  bool isBall() const { return ball_.radiusMm >= leastBallPixels * press_.pixelRatio * plane_.mmPerPixel; }
  void reach(QPointF p) {
    const glm::dvec2 pixel = glm::dvec2(p.x(), p.y()) * press_.pixelRatio;
    ball_.radiusMm = glm::distance(ball_.pPatient, plane_.patientFromPixel(pixel));
  }
  Result<SegmentWork> lesion() const {
    return lesionOf(press_.session, press_.segments->options().lesionThreshold, ball_);
  }

  const SlicePress press_;
  SlicePlane plane_;  // the plane shown, in device pixels
  LesionBall ball_;
};

}  // namespace

std::unique_ptr<Drag> beginLesion(const SlicePress& press) {
  return press.segments ? std::make_unique<LesionDrag>(press) : nullptr;
}

}  // namespace volumen
