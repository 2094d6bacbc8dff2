#include <QPainter>
#include <algorithm>
#include <utility>

#include "ui/controller/segment_editing.h"
#include "ui/tools/tool.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/links.h"
#include "viewer/segment/smart_brush.h"

namespace volumen {

namespace {

constexpr double brushStep = 1.2;
constexpr double smartDeviations = 2.5;

// Paints along the path of the brush; Ctrl at the press erases. The smart brush paints voxels connected to
// the pointer with values like those under the brush at the press.
class PaintDrag : public Drag {
 public:
  PaintDrag(const SlicePress& press, bool isSmart)
      : press_(press), isSmart_(isSmart), last_(press.patientAt(press.at)), stroke_(strokeOf(press)) {
    if (isSmart_) range_ = valuesUnder(under(last_), *press.series->volume, smartDeviations);
    goTo(press.at);
    stroke_.phase = SegmentStroke::Phase::goesOn;
  }
  ~PaintDrag() override {
    stroke_.phase = SegmentStroke::Phase::ends;
    stroke_.spans.clear();
    press_.segments->paint(stroke_);
  }

  void moveTo(QPointF p, Qt::KeyboardModifiers) override { goTo(p); }
  // All other keys are consumed so that the plane stays.
  bool takesKey(int key) override { return key != Qt::Key_Escape; }

 private:
  void goTo(QPointF p) {
    const Volume& volume = *press_.series->volume;
    const glm::dvec3 at = press_.patientAt(p);
    stroke_.spans = under(at);
    if (isSmart_) {
      const glm::ivec3 voxel(glm::floor(volume.geometry().voxelFromPatient(at) + 0.5));
      stroke_.spans = range_ ? connectedUnder(stroke_.spans, volume, *range_, voxel) : VoxelSpans();
    }
    last_ = at;
    press_.segments->paint(stroke_);
  }
  // Returns the voxels the brush covers on the way from the last position to `at`.
  VoxelSpans under(glm::dvec3 at) const {
    const Brush& brush = press_.session.preferences().brush;
    const VoxelGeometry& grid = press_.series->volume->geometry();
    const double radius = brush.diameterMm / 2;
    return brush.ball ? ballStroke(grid, last_, at, radius)
                      : discStroke(grid, last_, at, press_.plane.normal(), radius);
  }

  const SlicePress press_;
  const bool isSmart_;
  std::optional<ValueRange> range_;  // values the smart brush paints; empty if it paints nothing
  glm::dvec3 last_;                  // mm
  SegmentStroke stroke_;
};

}  // namespace

SlicePress ofPainted(SlicePress press) {
  const LoadedSeriesPtr& worked = press.session.series();
  const Workspace& workspace = press.session.workspace();
  if (press.frame || !worked || flatLookOf(workspace.view(press.view)).overlay != keyOf(worked->series))
    return press;
  const auto relation =
      relationOf(workspace, frameOfReference(press.series->series), frameOfReference(worked->series));
  if (!relation) return press;
  press.plane = carriedTo(relation->toFromFrom, press.plane);
  press.series = worked;
  return press;
}

SegmentStroke strokeOf(const SlicePress& press) {
  SegmentStroke stroke;
  stroke.series = keyOf(press.series->series);
  stroke.erases = press.keys & Qt::ControlModifier;
  stroke.onFrame = press.frame.has_value();
  return stroke;
}

std::unique_ptr<Drag> beginPaint(const SlicePress& press) {
  if (!press.segments) return nullptr;
  return std::make_unique<PaintDrag>(ofPainted(press), false);
}

std::unique_ptr<Drag> beginSmartBrush(const SlicePress& press) {
  if (!press.segments) return nullptr;
  return std::make_unique<PaintDrag>(ofPainted(press), true);
}

void paintBrushAt(QPainter& painter, const SlicePress& pointer) {
  const double mmPerPixel = pointer.plane.mmPerPixel * pointer.pixelRatio;
  const double radius = pointer.session.preferences().brush.diameterMm / 2 / mmPerPixel;
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  for (const auto& [colour, width] :
       {std::pair(QColor(0, 0, 0, 160), 3.0), std::pair(QColor(Qt::white), 1.0)}) {
    painter.setPen(QPen(colour, width));
    painter.drawEllipse(pointer.at, radius, radius);
  }
  painter.setRenderHint(QPainter::Antialiasing, false);
}

bool resizeBrush(Session& session, int key) {
  if (key != Qt::Key_Plus && key != Qt::Key_Minus) return false;
  session.prefer([key](Preferences& preferences) {
    double& mm = preferences.brush.diameterMm;
    mm = std::clamp(key == Qt::Key_Plus ? mm * brushStep : mm / brushStep, Brush::leastMm, Brush::mostMm);
  });
  return true;
}

}  // namespace volumen
