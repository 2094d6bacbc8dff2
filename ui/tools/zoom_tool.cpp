#include <algorithm>
#include <cmath>

#include "results/text/text.h"
#include "ui/tools/tool.h"
#include "ui/workspace/camera_moves.h"

namespace volumen {

namespace {

// Dragging up enlarges about the pressed point.
double zoomFactor(const Session& session, double down) {
  return std::exp((session.preferences().zoomDragInverted ? -0.008 : 0.008) * down);
}

class SliceZoomDrag : public Drag {
 public:
  explicit SliceZoomDrag(const SlicePress& press) : press_(press), atPress_(lookOf(press)) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    zoomFlat(press_.session, press_.view, atPress_, press_.plane, press_.patientAt(press_.at),
             1 / zoomFactor(press_.session, p.y() - press_.at.y()));
  }

 private:
  const SlicePress press_;
  const FlatLook atPress_;
};

class SceneZoomDrag : public SceneDrag {
 public:
  explicit SceneZoomDrag(const ScenePress& press) : press_(press), fixed_(fixedPlace(press)) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    press_.moveCamera(tr("Zoom"),
                      zoomedAt(press_.camera(), fixed_, zoomFactor(press_.session, p.y() - press_.at.y())));
  }

 private:
  // Returns the point at the target's depth if nothing is seen.
  static glm::dvec3 fixedPlace(const ScenePress& press) {
    if (press.seen || press.camera().projection != Projection::parallel) return press.pivot();
    return sightLine(press.camera(), press.size, {press.at.x(), press.at.y()}).origin;
  }

  const ScenePress press_;
  const glm::dvec3 fixed_;
};

}  // namespace

std::unique_ptr<Drag> beginSliceZoom(const SlicePress& press) {
  return std::make_unique<SliceZoomDrag>(press);
}

std::unique_ptr<SceneDrag> beginSceneZoom(const ScenePress& press) {
  return std::make_unique<SceneZoomDrag>(press);
}

}  // namespace volumen
