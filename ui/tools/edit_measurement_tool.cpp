#include <QCoreApplication>

#include "ui/tools/tool.h"
#include "ui/workspace/measurements.h"

namespace volumen {

namespace {

// Moves a part of a measurement by the movement of the pointer since the press.
class MeasurementDrag : public Drag {
 public:
  MeasurementDrag(const SlicePress& press, const MeasurementHit& hit)
      : press_(press), hit_(hit), atPress_(*findMeasurement(press.session.workspace(), hit.id)) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const glm::dvec3 way = press_.shapePointAt(p) - press_.shapePointAt(press_.at);
    editMeasurement(press_.session, hit_.id, text(), [&](Measurement& m) {
      m = atPress_;
      if (hit_.part == MeasurementPart::text)
        m.textOffset = hit_.textOffset + way;
      else if (hit_.part == MeasurementPart::handle)
        m.shape = withHandleAt(m.shape, hit_.handle, handlesOf(m.shape)[hit_.handle] + way, unit());
      else
        m.shape = movedBy(m.shape, way);
      // The shape no longer lies where it was picked in 3D.
      if (m.shape.points != atPress_.shape.points) m.shape.softMm.reset();
    });
  }

 private:
  // Points on frames are in pixels.
  glm::dvec3 unit() const {
    return press_.frame ? press_.series->volume->geometry().spacing() : glm::dvec3(1);
  }

  QString text() const {
    return hit_.part == MeasurementPart::text ? QCoreApplication::translate("volumen", "Move text")
           : hit_.part == MeasurementPart::handle
               ? QCoreApplication::translate("volumen", "Change measurement")
               : QCoreApplication::translate("volumen", "Move measurement");
  }

  const SlicePress press_;
  const MeasurementHit hit_;
  const Measurement atPress_;
};

}  // namespace

std::unique_ptr<Drag> beginMeasurementEdit(const SlicePress& press, const MeasurementHit& hit) {
  return std::make_unique<MeasurementDrag>(press, hit);
}

}  // namespace volumen
