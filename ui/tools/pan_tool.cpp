#include "results/text/text.h"
#include "ui/tools/tool.h"
#include "ui/workspace/camera_moves.h"

namespace volumen {

namespace {

class SlicePanDrag : public Drag {
 public:
  explicit SlicePanDrag(const SlicePress& press) : press_(press), atPress_(lookOf(press)) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const QPointF moved = (p - press_.at) * press_.pixelRatio * press_.plane.mmPerPixel;
    editFlat(press_.session, press_.view, tr("Pan"),
             [&](FlatLook& look) { look.panMm = atPress_.panMm - glm::dvec2(moved.x(), moved.y()); });
  }

 private:
  const SlicePress press_;
  const FlatLook atPress_;
};

// The pressed point follows the pointer.
class ScenePanDrag : public SceneDrag {
 public:
  explicit ScenePanDrag(const ScenePress& press) : press_(press) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const QPointF moved = p - press_.at;
    press_.moveCamera(tr("Pan"),
                      panned(press_.camera(), press_.size, {moved.x(), moved.y()}, press_.pivot()));
  }

 private:
  const ScenePress press_;
};

}  // namespace

std::unique_ptr<Drag> beginSlicePan(const SlicePress& press) { return std::make_unique<SlicePanDrag>(press); }

std::unique_ptr<SceneDrag> beginScenePan(const ScenePress& press) {
  return std::make_unique<ScenePanDrag>(press);
}

}  // namespace volumen
