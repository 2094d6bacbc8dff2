#include <QCoreApplication>

#include "ui/tools/flat_tool.h"

namespace volumen {

namespace {

class PanDrag : public Drag {
 public:
  explicit PanDrag(const FlatPress& press) : press_(press), atPress_(lookOf(press)) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const QPointF moved = (p - press_.at) * press_.pixelRatio * press_.plane.mmPerPixel;
    editFlat(press_.session, press_.view, QCoreApplication::translate("volumen", "Pan"),
             [&](FlatLook& look) { look.panMm = atPress_.panMm - glm::dvec2(moved.x(), moved.y()); });
  }

 private:
  const FlatPress press_;
  const FlatLook atPress_;
};

}  // namespace

std::unique_ptr<Drag> beginPan(const FlatPress& press) { return std::make_unique<PanDrag>(press); }

}  // namespace volumen
