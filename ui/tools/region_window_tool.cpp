#include <QCoreApplication>
#include <QLineF>
#include <QRectF>
#include <cmath>

#include "ui/tools/tool.h"
#include "ui/workspace/view_window.h"
#include "ui/workspace/windows.h"
#include "viewer/slice/slice.h"

namespace volumen {

namespace {

constexpr double leastPixels = 4;    // logical; a smaller box is a click
constexpr double mostSamples = 3e5;  // takes some milliseconds on one core

// Returns the values seen in a box, without padding. Large boxes are sampled at most `mostSamples` times.
std::vector<float> valuesIn(const SlicePress& press, const QRectF& box) {
  const Volume& volume = *press.series->volume;
  SlicePlane plane = press.plane;
  plane.average = false;
  plane.centre = press.patientAt(box.center());
  const glm::dvec2 pixels = press.pixelRatio * glm::dvec2(box.width(), box.height());
  const double samples = pixels.x * pixels.y * double(slabSamples(plane, volume.geometry()));
  const double coarser = std::max(1.0, std::sqrt(samples / mostSamples));
  plane.mmPerPixel *= coarser;
  plane.size = glm::max(glm::ivec2(pixels / coarser + 0.5), 1);
  Result<SliceValues> seen = resampleSlice(volume, plane);
  if (!seen) return {};
  std::erase_if(seen->values, [&](float v) { return isPadding(volume.attributes().padding, v); });
  return std::move(seen->values);
}

// Draws a box and sets the window to the values seen in it.
class RegionWindowDrag : public Drag {
 public:
  explicit RegionWindowDrag(const SlicePress& press) : press_(press), to_(press.at) {
    box_.id = -1 - press.view;  // not an id of the workspace
    box_.series = keyOf(press.series->series);
    box_.shape.kind = ShapeKind::rectangle;
    box_.shape.frame = press.frame;
    box_.shape.plane =
        press.frame ? ShapePlane{} : ShapePlane{press.plane.centre, press.plane.right, press.plane.down};
    box_.shape.points.assign(2, press.shapePointAt(press.at));
  }

  void moveTo(QPointF p, Qt::KeyboardModifiers) override {
    to_ = p;
    box_.shape.points.back() = press_.shapePointAt(p);
  }

  bool release(QPointF p, Qt::KeyboardModifiers keys) override {
    moveTo(p, keys);
    const QRectF box = QRectF(press_.at, to_).normalized();
    if (std::min(box.width(), box.height()) < leastPixels) return true;
    const auto window = windowOfValues(valuesIn(press_, box), press_.window, *press_.series);
    if (!window) return true;
    press_.session.endGesture();
    press_.session.change(QCoreApplication::translate("volumen", "Window from region"),
                          [&](Workspace& w) { setWindow(w, press_.view, window); });
    return true;
  }

  const Measurement* drawing() const override { return &box_; }
  bool isMeasured() const override { return false; }

 private:
  const SlicePress press_;
  QPointF to_;
  Measurement box_;
};

}  // namespace

std::unique_ptr<Drag> beginRegionWindow(const SlicePress& press) {
  return std::make_unique<RegionWindowDrag>(press);
}

}  // namespace volumen
