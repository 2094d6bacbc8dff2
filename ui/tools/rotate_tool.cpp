#include <cmath>

#include "results/text/text.h"
#include "ui/tools/tool.h"
#include "ui/workspace/camera_moves.h"

namespace volumen {

namespace {

constexpr double turnPerPixel = 0.008;  // rad

// Rotates the camera about the pressed point.
class OrbitDrag : public SceneDrag {
 public:
  explicit OrbitDrag(const ScenePress& press) : press_(press) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const QPointF moved = turnPerPixel * (p - press_.at);
    press_.moveCamera(tr("Rotate"), orbited(press_.camera(), press_.pivot(), moved.x(), moved.y()));
  }
  bool pointsWhereStill() const override { return true; }

 private:
  const ScenePress press_;
};

// Rotates the image about its centre.
class RollDrag : public SceneDrag {
 public:
  explicit RollDrag(const ScenePress& press) : press_(press) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    press_.moveCamera(tr("Rotate"), rolled(press_.camera(), angle(p) - angle(press_.at)));
  }

 private:
  double angle(QPointF p) const { return std::atan2(p.y() - press_.size.y / 2, p.x() - press_.size.x / 2); }

  const ScenePress press_;
};

}  // namespace

std::unique_ptr<SceneDrag> beginRotate(const ScenePress& press) {
  if (press.keys & Qt::ControlModifier) return std::make_unique<RollDrag>(press);
  return std::make_unique<OrbitDrag>(press);
}

}  // namespace volumen
