#include "ui/views/slice_view.h"

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

#include "ui/controller/measurer.h"
#include "ui/controller/references.h"
#include "ui/views/cine_player.h"
#include "ui/views/clip_lines.h"
#include "ui/views/cross_lines.h"
#include "ui/views/latin_key.h"
#include "ui/views/time_bar.h"
#include "ui/widgets/warning_badge.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/presented_frame.h"
#include "ui/workspace/text.h"
#include "ui/workspace/time_points.h"
#include "ui/workspace/windows.h"

namespace volumen {

namespace {

constexpr QRgb segmentColour = 0xffff6a3d;
constexpr double segmentOpacity = 0.5;

using Showed = std::optional<std::pair<SeriesKey, ViewKind>>;

// Whether a view shows another time point of what it showed: the picture stays until the new one is drawn.
bool isTimeStep(const Workspace& workspace, const Showed& last, const ViewState& now) {
  if (!last || last->second != now.kind || now.kind == ViewKind::frames) return false;
  const auto from = workspace.series.find(last->first), to = workspace.series.find(now.series);
  return from != workspace.series.end() && to != workspace.series.end() &&
         areTimePoints(*from->second.series, *to->second.series);
}

}  // namespace

SliceView::SliceView(Session& session, SliceService& service, FrameService& frames, Measurer& measurer,
                     References& references, ViewId id, QWidget* parent)
    : View(session, id, parent),
      service_(service),
      frames_(frames),
      measurer_(measurer),
      references_(references),
      badge_(new WarningBadge(this)),
      time_(new TimeBar(session, id, this)),
      tool_(&toolNamed("window")) {
  setObjectName(QStringLiteral("sliceView%1").arg(id));
  setAccessibleName(tr("Slice view"));
  setAttribute(Qt::WA_OpaquePaintEvent);
  wheelEnd_.setSingleShot(true);
  wheelEnd_.setInterval(500);
  connect(&wheelEnd_, &QTimer::timeout, this, [this] { session_.endGesture(); });
  connect(&service_, &SliceService::ready, this, &SliceView::showPicture);
  connect(&frames_, &FrameService::ready, this, &SliceView::takeFrame);
  connect(&frames_, &FrameService::failed, this, &SliceView::tellFrameFailure);
  connect(&measurer_, &Measurer::measured, this, [this] {
    update();
    tellPointed();
  });
  connect(&references_, &References::changed, this, [this] {
    askForPicture();
    update();
  });
  connect(this, &View::pixelsChanged, this, &SliceView::askForPicture);
  showed_ = {state().series, state().kind};
  seriesExchanged(true);
}

SliceView::~SliceView() = default;

std::optional<SlicePlane> SliceView::plane() const {
  const ShownSeriesPtr shown = this->shown();
  if (!shown || state().kind == ViewKind::volume) return {};
  const FlatLook look = flatLookOf(state());
  const SlicePlane plane =
      flatPlane(state(), look, shown->volume->geometry(), crosshairOf(session_.workspace(), id(), *shown),
                {pixels().width(), pixels().height()});
  return showsFrames() && frame_->how ? presentedPlane(*frame_, look, plane) : plane;
}

const SeriesState& SliceView::seriesState() const { return session_.workspace().series.at(state().series); }

GreyMapping SliceView::grey() const {
  const FlatLook look = flatLookOf(state());
  if (showsFrames()) return frameGrey(seriesState(), look, *frame_);
  GreyMapping grey = greyMapping(flatWindow(seriesState(), *series()), *series());
  grey.inverted = grey.inverted != look.inverted;
  return grey;
}

std::vector<SliceLayer> SliceView::layers() const {
  std::vector<SliceLayer> layers{{shown()->volume, grey(), seriesState().colours}};
  const FlatLook look = flatLookOf(state());
  const Workspace& workspace = session_.workspace();
  if (const ShownSeriesPtr over = session_.seriesNamed(look.overlay); over && !showsFrames())
    if (const auto relation =
            relationOf(workspace, frameOfReference(*seriesState().series), frameOfReference(over->series)))
      layers.push_back({over->volume,
                        greyMapping(overlayWindow(workspace.series.at(look.overlay), *over), *over),
                        look.overlayColours, look.overlayOpacity, relation->toFromFrom});
  if (segment_ && segment_->volume == shown()->volume)
    layers.push_back(
        {segment_->volume, {}, {}, segmentOpacity, {}, TintedRange{segment_->range, segmentColour}});
  return layers;
}

void SliceView::askForPicture() {
  const std::optional<SlicePlane> now = plane();
  if (!now || !isVisible() || now->size.x < 1 || now->size.y < 1) return;
  SliceRequest request{
      id(), layers(), *now, showsFrames() ? frame_ : nullptr, flatLookOf(state()).layers, segmentLayers()};
  if (asked_ == request) return;
  asked_ = request;
  service_.request(std::move(request));
}

void SliceView::showPicture(const SlicePicture& picture) {
  if (picture.request.view != id() || !asked_) return;
  // Of frames that come faster than they are drawn any is better than none.
  const auto& frame = picture.request.frame;
  const bool isOfClip = frame && showsFrames() && frame->key.series == state().series;
  if (picture.request.layers.front().volume != asked_->layers.front().volume && !isOfClip) return;
  picture_ = picture.image;
  picture_.setDevicePixelRatio(devicePixelRatioF());
  if (player_ && frame) player_->tellShown(frame->key.index);
  update();
  const bool isWanted = !showsFrames() || (frame_ && frame_->key == frameKey());
  if (isWanted && picture.request == *asked_) Q_EMIT settled();
}

void SliceView::seriesExchanged(bool another) {
  if (showsFrames()) return;
  if (another) picture_ = {}, asked_.reset();
  tellWarnings();
}

void SliceView::tellWarnings() {
  QStringList words, sentences;
  if (showsFrames()) {
    for (const std::string& sentence : frame_ ? frame_->warnings : std::vector<std::string>{})
      sentences << shownText(sentence);
    if (!sentences.isEmpty()) words << tr("Not all as the file says");
  } else if (const ShownSeriesPtr shown = series()) {
    for (const std::string& text : shortWarnings(shown->warnings)) words << QString::fromStdString(text);
    for (const Warning& w : changingPicture(shown->warnings)) sentences << shownText(w.sentence);
  }
  badge_->tell(words, sentences);
  placeBadge();
}

void SliceView::workspaceChanged(const Workspace&) {
  const std::pair now(state().series, state().kind);
  const Showed last = std::exchange(showed_, now);
  if (last != now) {
    drag_.reset();  // it is about what was shown
    if (!isTimeStep(session_.workspace(), last, state())) forgetFrame();
  }
  askForFrame();
  askForPicture();
  placeBadge();
  update();
}

void SliceView::placeBadge() {
  if (badge_->isHidden()) return;  // nothing to warn of
  const auto lines = shown() ? overlays().topLeft.size() : 0;
  badge_->move(8, 12 + int(lines) * (fontMetrics().height() + 1) + 4);
}

void SliceView::setTool(const Tool& tool) {
  if (drag_ && drag_->drawing()) drag_.reset();
  tool_ = &tool;
  update();
  tellPointed();
  setCursor(tool.cursor);
}

void SliceView::showSegment(const std::optional<VolumeRange>& segment) {
  segment_ = segment;
  askForPicture();
}

void SliceView::setClipShown(bool shown) {
  clipShown_ = shown;
  update();
}

void SliceView::scroll(int steps) {
  if (steps == 0) return;
  if (showsFrames()) {
    stop();
    return showFrame(session_, id(), flatLookOf(state()).frame + steps);
  }
  const ShownSeriesPtr shown = series();
  if (!shown) return;
  const Crosshair crosshair = crosshairOf(session_.workspace(), id(), *shown);
  moveCrosshair(session_, id(), *shown, tr("Scroll"),
                scrolled(shown->volume->geometry(), state().kind, crosshair, steps));
}

void SliceView::resetView() {
  if (state().series.empty()) return;
  Workspace after = session_.workspace();
  if (const ShownSeriesPtr shown = series(); shown && !showsFrames()) {
    const Crosshair before = crosshairOf(after, id(), *shown);
    if (before.byHand)
      after = withCrosshair(std::move(after), id(), frameOfReference(shown->series), before, {before.at});
  }
  makeWhole(after.editView(id()).flats.editOrAdd(state().series));
  session_.change(tr("Reset view"), after);
  session_.endGesture();
}

std::optional<SlicePress> SliceView::pressAt(QPointF p) const {
  const std::optional<SlicePlane> now = plane();
  if (!now) return {};
  const ShownSeriesPtr shown = this->shown();
  const Window window =
      showsFrames() ? seriesState().window.value_or(grey().window) : flatWindow(seriesState(), *shown);
  return SlicePress{session_, id(), shown, *now, devicePixelRatioF(), p, window, shapeFrame()};
}

// Whether its places are those of the patient.
bool SliceView::hasCursor() const { return !showsFrames() || (frame_ && frame_->geometry().calibrated); }

const Tool* SliceView::toolFor(const QMouseEvent& event) const {
  switch (event.button()) {
    case Qt::LeftButton:
      if (event.modifiers() & Qt::ShiftModifier && !tool_->measuring && hasCursor())
        return &toolNamed("crosshair");
      // What has no place in the patient has no crosshair.
      return !hasCursor() && tool_ == &toolNamed("crosshair") ? nullptr : tool_;
    case Qt::MiddleButton:
      return &toolNamed("pan");
    case Qt::RightButton:
      return &toolNamed("zoom");
    default:
      return nullptr;
  }
}

void SliceView::mousePressEvent(QMouseEvent* event) {
  View::mousePressEvent(event);
  const Tool* tool = toolFor(*event);
  if (tool && tool->measuring) stop();
  const auto press = pressAt(event->position());
  if (drag_ && event->button() == Qt::LeftButton) drag_->press(event->position());
  if (!tool || !press || drag_) return;
  session_.endGesture();
  if (tool == tool_ && !tool->measuring && windowRect().contains(event->position())) return typeWindow();
  pressedAt_ = event->position();
  stepsAtPress_ = session_.undoStack().index();
  if (tool == tool_) drag_ = pressMeasurement(*press);
  if (!drag_ && tool == tool_ && !tool->measuring && !showsFrames()) drag_ = beginOnLines(*press);
  if (!drag_ && tool == tool_ && !tool->measuring) drag_ = beginOnClip(*press, clipShown_);
  const bool isColour = showsFrames() && frame_ && frame_->colour();
  if (!drag_ && isColour && tool == &toolNamed("window")) return;  // colours have no window
  if (!drag_) drag_ = tool->inSlices(*press);
  if (drag_->drawing()) update();
}

void SliceView::mouseMoveEvent(QMouseEvent* event) {
  if (drag_) {
    drag_->moveTo(event->position(), event->modifiers());
    if (drag_->drawing()) update();
    return pointAt(event->position());
  }
  if (event->modifiers() & Qt::ShiftModifier && !tool_->measuring && hasCursor())
    if (const auto press = pressAt(event->position())) beginCrosshair(*press);
  showCursorAt(event->position());
  pointAt(event->position());
}

QString SliceView::textAt(QPointF position) const {
  const QString measured = measurementText(position);
  return measured.isEmpty() ? hoverText(position) : measured;
}

void SliceView::mouseReleaseEvent(QMouseEvent* event) {
  if (drag_ && drag_->drawing() &&
      (event->button() != Qt::LeftButton || !drag_->release(event->position(), event->modifiers())))
    return update();
  const bool isClick = (event->position() - pressedAt_).manhattanLength() < QApplication::startDragDistance();
  const bool wantsMenu = drag_ && event->button() == Qt::RightButton && isClick;
  endDrag(event->modifiers());
  if (wantsMenu) Q_EMIT menuRequested(event->globalPosition().toPoint());
}

void SliceView::wheelEvent(QWheelEvent* event) {
  pointAt(event->position());
  const auto press = pressAt(event->position());
  if (!press || drag_) return;
  // Alt makes a wheel horizontal on some systems.
  const double notches = (event->angleDelta().y() + event->angleDelta().x()) / 120.0;
  wheelEnd_.start();
  if (event->modifiers() & Qt::ControlModifier) {
    const double sign = session_.preferences().wheelInverted ? -1 : 1;
    return zoomFlat(session_, id(), flatLookOf(state()), press->plane, press->patientAt(press->at),
                    std::pow(0.85, -sign * notches));
  }
  wheelRest_ -= notches;
  const int steps = int(std::trunc(wheelRest_));
  wheelRest_ -= steps;
  if (event->modifiers() & Qt::AltModifier) return makeSlabThicker(-steps);
  scroll(steps);
}

void SliceView::makeSlabThicker(int steps) {
  const ShownSeriesPtr shown = series();
  if (!shown || showsFrames() || steps == 0) return;
  const double step = wheelStep(shown->volume->geometry(), plane()->normal());
  editFlat(session_, id(), tr("Slab"), [&](FlatLook& look) {
    look.slabMm = std::clamp(std::round(look.slabMm / step + steps) * step, 0.0, 500.0);
  });
}

void SliceView::keyPressEvent(QKeyEvent* event) {
  if (pressMeasuringKey(*event)) return;
  switch (latinKey(*event)) {
    case Qt::Key_Up:
      return scroll(-1);
    case Qt::Key_Down:
      return scroll(1);
    case Qt::Key_PageUp:
      return scroll(-10);
    case Qt::Key_PageDown:
      return scroll(10);
    case Qt::Key_Home:
      return scroll(-place().count);
    case Qt::Key_End:
      return scroll(place().count);
    case Qt::Key_Left:
    case Qt::Key_Right:
      if (!time_->hasSteps()) break;
      return time_->step(event->key() == Qt::Key_Left ? -1 : 1);
    case Qt::Key_I:
      return invert();
    case Qt::Key_Escape:
      if (!drag_) break;
      drag_.reset();
      update();
      while (session_.undoStack().index() > stepsAtPress_) session_.undoStack().undo();
      tellPointed();
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
  askForFrame();
  askForPicture();
}

void SliceView::resizeEvent(QResizeEvent* event) {
  placeBadge();
  placeTimeBar();
  View::resizeEvent(event);
}

}  // namespace volumen
