#include <QAction>
#include <QKeyEvent>
#include <QKeySequence>
#include <QMouseEvent>
#include <algorithm>
#include <glm/geometric.hpp>

#include "ui/views/cine_bar.h"
#include "results/text/measured_text.h"
#include "ui/views/latin_key.h"
#include "ui/views/volume_view.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/measurement_text.h"
#include "ui/workspace/measurements.h"

namespace volumen {

namespace {

// Returns the texts of a measurement. Results come from its own series and are missing while that is not in
// memory. A measurement being drawn has them once it has all its points. Shapes in 3D take no time to
// measure.
QStringList textInScene(const Measurement& m, const LoadedSeriesPtr& series) {
  QStringList text;
  if (!m.shape.name.empty()) text << nameText(m);
  if (series && checkShape(m.shape))
    text << measuredLines(m.shape, measure(m.shape, *series->volume, series->series.unit));
  return text;
}

}  // namespace

void VolumeView::setFlatTool(const Tool& tool) {
  drawing_ = tool.draws() && tool.inScene ? &tool : nullptr;
  if (shape_ || (drag_ && drag_->drawsOver())) letGo();
  setCursor(drawing_ ? drawing_->cursor : tool_->cursor);
}

bool VolumeView::hasKey(const Tool& tool) const {
  const QKeySequence key(tool.key);
  return tool.draws() && tool.inScene && tool.key != 0 &&
         std::ranges::none_of(window()->actions(),
                              [&](const QAction* action) { return action->shortcuts().contains(key); });
}

void VolumeView::redraw() {
  placed_.reset();
  canvas_->update();
}

std::shared_ptr<const std::vector<DrawnMeasurement>> VolumeView::placedMeasurements() const {
  if (placed_) return placed_;
  placed_ = std::make_shared<const std::vector<DrawnMeasurement>>(placeMeasurements());
  placedZoom_ = zoom();
  painted_ = {};
  return placed_;
}

std::vector<DrawnMeasurement> VolumeView::placeMeasurements() const {
  std::vector<DrawnMeasurement> drawn;
  const LoadedSeriesPtr shown = series();
  if (!shown) return drawn;
  const Workspace& workspace = session_.workspace();
  const Camera seen = camera();
  const auto add = [&](const Measurement& m, bool selected) {
    DrawnMeasurement one = drawnInScene(
        m, [&](glm::dvec3 p) { return seenAtPlace(seen, p); }, selected);
    if (one.lines.empty()) return;
    one.text = textInScene(m, session_.seriesNamed(m.series));
    if (m.id > 0)
      std::erase_if(one.handles,
                    [&](const auto& handle) { return !isSeenAt(handle.at, m.shape, handle.index); });
    drawn.push_back(std::move(one));
  };
  if (workspace.measurementsShown)
    for (const Measurement* m : measurementsIn(workspace, frameOfReference(shown->series)))
      add(*m, m->id == workspace.selected);
  if (shape_) add(*shape_->drawing(), true);
  if (!drawn.empty()) placeBeside(overlays(), drawn, overlayArea(), font());
  return drawn;
}

// Returns whether a point picked in 3D is visible where it is drawn, on a surface and not hidden.
bool VolumeView::isSeenAt(QPointF position, const Shape& shape, std::size_t point) const {
  const std::optional<Pick> hit = shape.softMm ? pickAt(position) : std::nullopt;
  if (!hit || !hit->pPatient || !hit->softMm) return false;
  const glm::dvec3 voxel = series()->volume->geometry().spacing();
  return glm::distance(*hit->pPatient, shape.points[point]) <=
         *shape.softMm + std::max({voxel.x, voxel.y, voxel.z});
}

void VolumeView::tellMissed(QPointF position) {
  const std::optional<Pick> hit = pickAt(position);
  Q_EMIT missed(
      hit ? tr("A projection does not show how deep a place lies: choose the mode 3D to measure here.")
          : tr("Nothing is seen there: click on a visible surface to measure in 3D."));
}

// Selects the measurement under the press, whose points can be moved. Elsewhere the selection stays until the
// press proves to be a click.
std::unique_ptr<SceneDrag> VolumeView::pressMeasurement(const ScenePress& press) {
  const std::vector<DrawnMeasurement> drawn = drawnMeasurements();
  const auto hit = hitAt(drawn, press.at);
  pressedShape_ = hit.has_value();
  pressedFree_ = !hit;
  if (!hit) return nullptr;
  session_.select(hit->drawn->id);
  if (hit->part != MeasurementPart::handle) return nullptr;
  cine_->stop();
  const auto handle = std::ranges::find(hit->drawn->handles, hit->handle, &DrawnMeasurement::Handle::index);
  return beginSurfacePoint(press, hit->drawn->id, hit->handle, handle->at);
}

void VolumeView::releaseShape(const QMouseEvent& event) {
  auto shape = std::move(shape_);
  const bool isDone = shape->release(event.position(), event.modifiers());
  if (!isDone) shape_ = std::move(shape);
  redraw();
  if (isDone && !(event.modifiers() & Qt::ShiftModifier)) Q_EMIT toolDone();
}

// A click adds the next point, however soon it follows.
void VolumeView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && drawing_) return mousePressEvent(event);
  takePickBack();
  View::mouseDoubleClickEvent(event);
}

// Handles the keys of drawing tools, of Esc and of deletion. Returns false for other keys.
bool VolumeView::pressMeasuringKey(const QKeyEvent& event) {
  if (event.key() == Qt::Key_Delete) {
    const bool isSeen = std::ranges::any_of(drawnMeasurements(), &DrawnMeasurement::selected);
    if (isSeen && !drag_ && !shape_) deleteMeasurement(session_, session_.workspace().selected);
    return isSeen;
  }
  if (event.key() == Qt::Key_Escape && drawing_) {
    Q_EMIT toolDone();
    return true;
  }
  if (event.modifiers() & ~Qt::ShiftModifier) return false;
  const auto tool = std::ranges::find_if(
      tools(), [&, key = latinKey(event)](const Tool& t) { return t.key == key && hasKey(t); });
  if (tool != tools().end()) Q_EMIT toolWanted(*tool);
  return tool != tools().end();
}

void VolumeView::showCursorAt(QPointF position) {
  if (drawing_) return;
  const std::vector<DrawnMeasurement> drawn = drawnMeasurements();
  setCursor(hitAt(drawn, position) ? Qt::PointingHandCursor : tool_->cursor);
}

QString VolumeView::measurementText(QPointF position) const {
  const std::vector<DrawnMeasurement> drawn = drawnMeasurements();
  const auto hit = hitAt(drawn, position);
  const Measurement* m = hit ? findMeasurement(session_.workspace(), hit->drawn->id) : nullptr;
  if (!m) return {};
  const LoadedSeriesPtr taken = session_.seriesNamed(m->series);
  return taken ? detailText(*m, measure(m->shape, *taken->volume, taken->series.unit), taken->series)
               : nameText(*m);
}

}  // namespace volumen
