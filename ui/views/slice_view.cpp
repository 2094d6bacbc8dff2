#include "ui/views/slice_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

#include "ui/controller/measurer.h"
#include "ui/widgets/warning_badge.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/text.h"
#include "ui/workspace/windows.h"

namespace volumen {

SliceView::SliceView(Session& session, SliceService& service, Measurer& measurer, ViewId id, QWidget* parent)
    : View(session, id, parent),
      service_(service),
      measurer_(measurer),
      badge_(new WarningBadge(this)),
      tool_(&flatTool("window")) {
  setObjectName(QStringLiteral("sliceView%1").arg(id));
  setAccessibleName(tr("Slice view"));
  setMinimumSize(100, 100);
  setAttribute(Qt::WA_OpaquePaintEvent);
  wheelEnd_.setSingleShot(true);
  wheelEnd_.setInterval(500);
  connect(&wheelEnd_, &QTimer::timeout, this, [this] { session_.endGesture(); });
  connect(&service_, &SliceService::ready, this, &SliceView::showPicture);
  connect(&measurer_, &Measurer::measured, this, qOverload<>(&QWidget::update));
  connect(this, &View::pixelsChanged, this, &SliceView::askForPicture);
  seriesExchanged(true);
}

std::optional<SlicePlane> SliceView::plane() const {
  const ShownSeriesPtr shown = series();
  if (!shown || state().kind == ViewKind::volume) return {};
  return flatPlane(state(), flatLookOf(state()), shown->volume->geometry(),
                   cursorOf(session_.workspace(), *shown), {pixels().width(), pixels().height()});
}

GreyMapping SliceView::grey() const {
  const ShownSeriesPtr shown = series();
  const SeriesState& state = session_.workspace().series.at(keyOf(shown->series));
  return greyMapping(flatWindow(state, *shown), *shown);
}

void SliceView::askForPicture() {
  const std::optional<SlicePlane> now = plane();
  if (!now || !isVisible() || now->size.x < 1 || now->size.y < 1) return;
  SliceRequest request{id(), series()->volume, *now, grey()};
  if (asked_ && asked_->volume == request.volume && asked_->plane == request.plane &&
      asked_->grey == request.grey)
    return;
  asked_ = request;
  service_.request(std::move(request));
}

void SliceView::showPicture(const SlicePicture& picture) {
  if (picture.request.view != id() || !asked_ || picture.request.volume != asked_->volume) return;
  picture_ = picture.image;
  picture_.setDevicePixelRatio(devicePixelRatioF());
  update();
  if (picture.request.plane == asked_->plane && picture.request.grey == asked_->grey) Q_EMIT settled();
}

void SliceView::seriesExchanged(bool another) {
  if (another) picture_ = {}, asked_.reset();
  QStringList words, sentences;
  if (const ShownSeriesPtr shown = series()) {
    for (const std::string& text : shortWarnings(shown->warnings)) words << QString::fromStdString(text);
    for (const Warning& w : changingPicture(shown->warnings)) sentences << shownText(w.sentence);
  }
  badge_->tell(words, sentences);
  placeBadge();
}

void SliceView::workspaceChanged(const Workspace&) {
  askForPicture();
  update();
}

void SliceView::placeBadge() {
  const auto lines = series() ? overlays().topLeft.size() : 0;
  badge_->move(8, 12 + int(lines) * (fontMetrics().height() + 1) + 4);
}

void SliceView::setTool(const FlatTool& tool) {
  if (drag_ && drag_->drawing()) drag_.reset();
  tool_ = &tool;
  update();
  setCursor(tool.cursor);
}

void SliceView::scroll(int steps) {
  const ShownSeriesPtr shown = series();
  if (!shown || steps == 0) return;
  const glm::dvec3 cursor = cursorOf(session_.workspace(), *shown);
  moveCursor(session_, shown->series, tr("Scroll"),
             scrolled(shown->volume->geometry(), state().kind, cursor, steps));
}

void SliceView::resetView() {
  editFlat(session_, id(), tr("Reset view"),
           [](FlatLook& look) { look = FlatLook{.nearest = look.nearest}; });
  session_.endGesture();
}

std::optional<FlatPress> SliceView::pressAt(QPointF p) const {
  const std::optional<SlicePlane> now = plane();
  if (!now) return {};
  return FlatPress{session_, id(), series(), *now, devicePixelRatioF(), p};
}

const FlatTool* SliceView::toolFor(const QMouseEvent& event) const {
  switch (event.button()) {
    case Qt::LeftButton:
      return event.modifiers() & Qt::ShiftModifier && !tool_->measuring ? &flatTool("crosshair") : tool_;
    case Qt::MiddleButton:
      return &flatTool("pan");
    case Qt::RightButton:
      return &flatTool("zoom");
    default:
      return nullptr;
  }
}

void SliceView::mousePressEvent(QMouseEvent* event) {
  View::mousePressEvent(event);
  const FlatTool* tool = toolFor(*event);
  const auto press = pressAt(event->position());
  if (drag_ && event->button() == Qt::LeftButton) drag_->press(event->position());
  if (!tool || !press || drag_) return;
  session_.endGesture();
  stepsAtPress_ = session_.undoStack().index();
  if (tool == tool_) drag_ = pressMeasurement(*press);
  if (!drag_) drag_ = tool->begin(*press);
  if (drag_->drawing()) update();
}

void SliceView::mouseMoveEvent(QMouseEvent* event) {
  if (drag_) {
    drag_->moveTo(event->position(), event->modifiers());
    if (drag_->drawing()) update();
    return;
  }
  if (event->modifiers() & Qt::ShiftModifier && !tool_->measuring)
    if (const auto press = pressAt(event->position())) beginCrosshair(*press);
  showCursorAt(event->position());
  const QString measured = measurementText(event->position());
  Q_EMIT hovered(measured.isEmpty() ? hoverText(event->position()) : measured);
}

void SliceView::mouseReleaseEvent(QMouseEvent* event) {
  if (drag_ && drag_->drawing() && (event->button() != Qt::LeftButton || !drag_->release(event->position())))
    return update();
  endDrag(event->modifiers());
}

void SliceView::wheelEvent(QWheelEvent* event) {
  const auto press = pressAt(event->position());
  if (!press || drag_) return;
  // Alt makes a wheel horizontal on some systems.
  const double notches = (event->angleDelta().y() + event->angleDelta().x()) / 120.0;
  wheelEnd_.start();
  if (event->modifiers() & Qt::ControlModifier) {
    const double sign = session_.preferences().wheelInverted ? -1 : 1;
    return zoomFlat(session_, id(), flatLookOf(state()), press->series->volume->geometry(), press->plane,
                    press->patientAt(press->at), std::pow(0.85, -sign * notches));
  }
  wheelRest_ -= notches;
  const int steps = int(std::trunc(wheelRest_));
  wheelRest_ -= steps;
  if (event->modifiers() & Qt::AltModifier) return makeSlabThicker(-steps);
  scroll(steps);
}

void SliceView::makeSlabThicker(int steps) {
  const ShownSeriesPtr shown = series();
  if (!shown || steps == 0) return;
  const double step = wheelStep(shown->volume->geometry(), plane()->normal());
  editFlat(session_, id(), tr("Slab"), [&](FlatLook& look) {
    look.slabMm = std::clamp(std::round(look.slabMm / step + steps) * step, 0.0, 500.0);
  });
}

// 0: as the series says; 1 and on: those of the menu.
void SliceView::chooseWindow(int number) {
  const ShownSeriesPtr shown = series();
  if (!shown) return;
  const std::vector<NamedWindow> choices = windowChoices(*shown);
  if (number >= int(choices.size())) return;
  session_.change(tr("Window"), [&](Workspace& w) {
    w.series.at(keyOf(shown->series)).window = choices[std::size_t(number)].window;
  });
}

void SliceView::keyPressEvent(QKeyEvent* event) {
  const auto whole = [this] {
    const ShownSeriesPtr shown = series();
    return shown ? stackPlace(shown->volume->geometry(), state().kind, cursorOf(session_.workspace(), *shown))
                       .count
                 : 0;
  };
  if (pressMeasuringKey(*event)) return;
  switch (event->key()) {
    case Qt::Key_Up:
      return scroll(-1);
    case Qt::Key_Down:
      return scroll(1);
    case Qt::Key_PageUp:
      return scroll(-10);
    case Qt::Key_PageDown:
      return scroll(10);
    case Qt::Key_Home:
      return scroll(-whole());
    case Qt::Key_End:
      return scroll(whole());
    case Qt::Key_Escape:
      if (!drag_) break;
      drag_.reset();
      update();
      while (session_.undoStack().index() > stepsAtPress_) session_.undoStack().undo();
      return session_.endGesture();
    default:
      if (event->key() < Qt::Key_0 || event->key() > Qt::Key_9 || event->modifiers() != Qt::NoModifier) break;
      return chooseWindow(event->key() - Qt::Key_0);
  }
  View::keyPressEvent(event);
}

void SliceView::leaveEvent(QEvent* event) {
  update();
  View::leaveEvent(event);
}

void SliceView::showEvent(QShowEvent* event) {
  View::showEvent(event);
  askForPicture();
}

void SliceView::resizeEvent(QResizeEvent* event) {
  placeBadge();
  View::resizeEvent(event);
}

}  // namespace volumen
