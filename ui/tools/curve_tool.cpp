#include <cmath>

#include "results/text/text.h"
#include "ui/tools/tool.h"
#include "ui/workspace/windows.h"
#include "viewer/scene/curve_edits.h"

namespace volumen {

namespace {

// Dragging up shifts the curve to lower values, dragging right widens it.
class CurveDrag : public SceneDrag {
 public:
  explicit CurveDrag(const ScenePress& press) : press_(press) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const QPointF moved = p - press_.at;
    const Histogram& histogram = press_.series->histogram;
    const double half = press_.session.preferences().curveDragInverted ? -0.5 : 0.5;
    const TransferFunction curve =
        shifted(widened(press_.scene.transferFunction, std::exp(2 * moved.x() / press_.size.x)),
                half * moved.y() / press_.size.y * (histogram.high - histogram.low));
    const QString text = tr("Adjust curve");
    press_.session.edit(
        press_.view, text, [&](Scene& s) { s.transferFunction = curve; }, text);
  }

 private:
  const ScenePress press_;
};

// Dragging up makes everything more opaque.
class OpacityDrag : public SceneDrag {
 public:
  explicit OpacityDrag(const ScenePress& press) : press_(press) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    const double factor = std::exp(-6 * (p.y() - press_.at.y()) / press_.size.y);
    const QString text = tr("Adjust opacity");
    press_.session.edit(
        press_.view, text,
        [&](Scene& s) { s.transferFunction = withOpacityScaled(press_.scene.transferFunction, factor); },
        text);
  }

 private:
  const ScenePress press_;
};

// Changes the window of projections, as in slices.
class SceneWindowDrag : public SceneDrag {
 public:
  explicit SceneWindowDrag(const ScenePress& press)
      : press_(press), atPress_(windowInUse(press.scene, *press.series)) {}

  void moveTo(QPointF p, Qt::KeyboardModifiers keys) override {
    const QPointF moved = windowDragSpeed(keys) * (p - press_.at);
    const Window window = draggedWindow(atPress_, {moved.x(), moved.y()}, *press_.series);
    const QString text = tr("Window");
    press_.session.edit(
        press_.view, text, [&](Scene& s) { s.window = window; }, text);
  }

 private:
  const ScenePress press_;
  const Window atPress_;
};

}  // namespace

std::unique_ptr<SceneDrag> beginCurve(const ScenePress& press) {
  if (press.scene.mode != Mode::composite) return std::make_unique<SceneWindowDrag>(press);
  if (press.keys & Qt::ControlModifier) return std::make_unique<OpacityDrag>(press);
  return std::make_unique<CurveDrag>(press);
}

}  // namespace volumen
