#include <QCoreApplication>

#include "ui/tools/tool.h"

namespace volumen {

namespace {

class CrosshairDrag : public Drag {
 public:
  explicit CrosshairDrag(const SlicePress& press) : press_(press) { moveTo(press.at, {}); }

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    moveCrosshair(press_.session, press_.view, *press_.series,
                  QCoreApplication::translate("volumen", "Crosshair"), press_.patientAt(p));
  }

 private:
  const SlicePress press_;
};

}  // namespace

std::unique_ptr<Drag> beginCrosshair(const SlicePress& press) {
  return std::make_unique<CrosshairDrag>(press);
}

}  // namespace volumen
