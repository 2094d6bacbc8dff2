#include <QPainter>
#include <QPainterPath>

#include "results/text/text.h"
#include "ui/controller/segment_editing.h"
#include "ui/tools/tool.h"
#include "viewer/slice/level_trace.h"

namespace volumen {

namespace {

const QColor traceColour(0x80, 0xde, 0xea);

// Caches the values of the last traced slice, because the pointer stays on one slice for a while.
struct TracedSlice {
  std::weak_ptr<const Volume> volume;
  SlicePlane plane;
  SliceValues values;
};

// Returns the contour in device pixels; empty outside the volume.
std::vector<glm::dvec2> traceAt(const SlicePress& pointer) {
  static TracedSlice last;
  const VolumePtr& volume = pointer.series->volume;
  if (last.volume.lock() != volume || last.plane != pointer.plane) {
    Result<SliceValues> values = resampleSlice(*volume, pointer.plane);
    if (!values) return {};
    last = {volume, pointer.plane, std::move(*values)};
  }
  return levelTrace(last.values, glm::dvec2(pointer.at.x(), pointer.at.y()) * pointer.pixelRatio);
}

}  // namespace

void paintLevelTrace(QPainter& painter, const SlicePress& shown) {
  const SlicePress pointer = ofPainted(shown);
  if (pointer.frame) return;
  QPolygonF line;
  for (const glm::dvec2 p : traceAt(pointer)) line << QPointF(p.x, p.y) / pointer.pixelRatio;
  QPainterPath path;
  path.addPolygon(line);
  path.closeSubpath();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& [colour, width] : {std::pair(QColor(0, 0, 0, 150), 3.0), std::pair(traceColour, 1.4)})
    painter.strokePath(path, QPen(colour, width, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
  painter.setRenderHint(QPainter::Antialiasing, false);
}

// Paints the inside at the press, so that there is no drag. Ctrl erases it.
std::unique_ptr<Drag> beginLevelTrace(const SlicePress& pressed) {
  if (!pressed.segments) return nullptr;
  const SlicePress press = ofPainted(pressed);
  SegmentStroke stroke = strokeOf(press);
  if (!stroke.onFrame) {
    std::vector<glm::dvec3> outline;
    for (const glm::dvec2 p : traceAt(press)) outline.push_back(press.plane.patientFromPixel(p));
    if (outline.empty()) return nullptr;
    stroke.spans = insideOutline(press.series->volume->geometry(), outline, press.plane.normal());
  }
  press.segments->paintAll(stroke);
  return nullptr;
}

}  // namespace volumen
