// An addition: a 3D tool whose drags rotate only about the vertical axis.
#include "ui/tools/tool.h"
#include "ui/workspace/camera_moves.h"

namespace volumen {

namespace {

class SpinDrag : public SceneDrag {
 public:
  explicit SpinDrag(const ScenePress& press) : press_(press) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    constexpr double turnPerPixel = 0.01;  // rad
    press_.moveCamera(QStringLiteral("Spin"),
                      orbited(press_.camera(), press_.pivot(), turnPerPixel * (p.x() - press_.at.x()), 0));
  }

 private:
  const ScenePress press_;
};

}  // namespace

std::unique_ptr<SceneDrag> beginSpin(const ScenePress& press) { return std::make_unique<SpinDrag>(press); }

}  // namespace volumen
