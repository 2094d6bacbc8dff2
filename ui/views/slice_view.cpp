#include "ui/views/slice_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

#include "ui/views/cross_lines.h"
#include "ui/widgets/warning_badge.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/text.h"
#include "ui/workspace/windows.h"

namespace volumen {

SliceView::SliceView(Session& session, SliceService& service, ViewId id, QWidget* parent)
    : View(session, id, parent),
      service_(service),
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
  connect(this, &View::pixelsChanged, this, &SliceView::askForPicture);
  seriesExchanged(true);
}

std::optional<SlicePlane> SliceView::plane() const {
  const ShownSeriesPtr shown = series();
  if (!shown || state().kind == ViewKind::volume) return {};
  return flatPlane(state(), flatLookOf(state()), shown->volume->geometry(),
                   crosshairOf(session_.workspace(), *shown), {pixels().width(), pixels().height()});
}

std::vector<SliceLayer> SliceView::layers() const {
  const ShownSeriesPtr shown = series();
  const SeriesState& below = session_.workspace().series.at(keyOf(shown->series));
  std::vector<SliceLayer> layers{
      {shown->volume, greyMapping(flatWindow(below, *shown), *shown), below.colours}};
  const FlatLook look = flatLookOf(state());
  if (const ShownSeriesPtr over = session_.seriesNamed(look.overlay))
    layers.push_back({over->volume,
                      greyMapping(overlayWindow(session_.workspace().series.at(look.overlay), *over), *over),
                      look.overlayColours, look.overlayOpacity});
  return layers;
}

void SliceView::askForPicture() {
  const std::optional<SlicePlane> now = plane();
  if (!now || !isVisible() || now->size.x < 1 || now->size.y < 1) return;
  SliceRequest request{id(), layers(), *now};
  if (asked_ == request) return;
  asked_ = request;
  service_.request(std::move(request));
}

void SliceView::showPicture(const SlicePicture& picture) {
  if (picture.request.view != id() || !asked_) return;
  if (picture.request.layers.front().volume != asked_->layers.front().volume) return;
  picture_ = picture.image;
  picture_.setDevicePixelRatio(devicePixelRatioF());
  update();
  if (picture.request == *asked_) Q_EMIT settled();
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
  tool_ = &tool;
  setCursor(tool.cursor);
}

void SliceView::scroll(int steps) {
  const ShownSeriesPtr shown = series();
  if (!shown || steps == 0) return;
  const Crosshair crosshair = crosshairOf(session_.workspace(), *shown);
  moveCrosshair(session_, *shown, tr("Scroll"),
                scrolled(shown->volume->geometry(), state().kind, crosshair, steps));
}

void SliceView::resetView() {
  const ShownSeriesPtr shown = series();
  if (!shown) return;
  const Crosshair before = crosshairOf(session_.workspace(), *shown);
  Workspace after = withCrosshair(session_.workspace(), shown->series, before, {before.at});
  FlatLook& look = after.view(id()).flats[state().series];
  look = FlatLook{.nearest = look.nearest};
  session_.change(tr("Reset view"), after);
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
      return event.modifiers() & Qt::ShiftModifier ? &flatTool("crosshair") : tool_;
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
  if (!tool || !press || drag_) return;
  session_.endGesture();
  stepsAtPress_ = session_.undoStack().index();
  const bool onLines = event->button() == Qt::LeftButton && event->modifiers() == Qt::NoModifier;
  if (onLines) drag_ = beginOnLines(*press);
  if (!drag_) drag_ = tool->begin(*press);
}

void SliceView::mouseMoveEvent(QMouseEvent* event) {
  if (drag_) return drag_->moveTo(event->position(), event->modifiers());
  if (event->modifiers() & Qt::ShiftModifier)
    if (const auto press = pressAt(event->position())) beginCrosshair(*press);
  const auto press = pressAt(event->position());
  setCursor(press && isOnLines(*press) ? Qt::PointingHandCursor : tool_->cursor);
  Q_EMIT hovered(hoverText(event->position()));
}

void SliceView::mouseReleaseEvent(QMouseEvent*) {
  drag_.reset();
  session_.endGesture();
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
    return shown ? stackPlace(shown->volume->geometry(), state().kind,
                              crosshairOf(session_.workspace(), *shown))
                       .count
                 : 0;
  };
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
