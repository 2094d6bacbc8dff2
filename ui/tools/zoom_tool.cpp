#include <algorithm>
#include <cmath>

#include "ui/tools/flat_tool.h"

namespace volumen {

namespace {

// Up enlarges about the point pressed, as in 3D.
class ZoomDrag : public Drag {
 public:
  explicit ZoomDrag(const FlatPress& press) : press_(press), atPress_(lookOf(press)) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const double sign = press_.session.preferences().zoomDragInverted ? 1 : -1;
    zoomFlat(press_.session, press_.view, atPress_, press_.plane, press_.patientAt(press_.at),
             std::exp(sign * 0.008 * (p.y() - press_.at.y())));
  }

 private:
  const FlatPress press_;
  const FlatLook atPress_;
};

}  // namespace

std::unique_ptr<Drag> beginFlatZoom(const FlatPress& press) { return std::make_unique<ZoomDrag>(press); }

}  // namespace volumen
