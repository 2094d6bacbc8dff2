#include "ui/views/flat_view.h"

#include <algorithm>
#include <cmath>

#include "results/text/text.h"
#include "results/text/text.h"
#include "ui/controller/derived_objects.h"
#include "ui/controller/segment_editing.h"
#include "ui/derivations/measured_numbers.h"
#include "ui/views/cine_bar.h"
#include "ui/widgets/warning_badge.h"
#include "ui/workspace/time_points.h"
#include "ui/workspace/view_window.h"

namespace volumen {

namespace {

bool areTimePointsIn(const Workspace& workspace, const SeriesKey& a, const SeriesKey& b) {
  const auto& all = workspace.series;
  const auto first = all.find(a), second = all.find(b);
  return first != all.end() && second != all.end() &&
         areTimePoints(*first->second.series, *second->second.series);
}

}  // namespace

FlatView::FlatView(const ViewParts& parts, ViewId id, QWidget* parent)
    : View(parts.session, id, parent),
      service_(parts.slices),
      derived_(parts.derived),
      cine_(new CineBar(
          parts.session, id, [this] { return isAtRest(); }, this)),
      measurer_(parts.measurer),
      segments_(parts.segments),
      showed_(state().series, state().kind),
      badge_(new WarningBadge(this)),
      tool_(&toolNamed("window")) {
  setAccessibleName(tr("Slice view"));
  setAttribute(Qt::WA_OpaquePaintEvent);
  wheelEnd_.setSingleShot(true);
  wheelEnd_.setInterval(500);
  connect(&wheelEnd_, &QTimer::timeout, this, [this] { session_.endGesture(); });
  connect(&service_, &SliceService::ready, this, &FlatView::showPicture);
  connect(&measurer_, &MeasuredNumbers::changed, this, [this] {
    update();
    tellPointed();
  });
  connect(&derived_, &DerivedObjects::changed, this, [this] {
    askForPicture();
    update();
  });
  if (segments_) connect(segments_, &SegmentEditing::previewChanged, this, &FlatView::askForPicture);
  connect(this, &View::pixelsChanged, this, &FlatView::askForPicture);
  connect(cine_, &CineBar::shownChanged, this, [this] {
    placeCineBar();
    update();
  });
}

FlatView::~FlatView() = default;

std::optional<SlicePlane> FlatView::plane() const {
  if (!shown()) return {};
  return planeShown(fittedPlane(session_.workspace(), pixels()));
}

SlicePlane FlatView::fittedPlane(const Workspace& workspace, QSize pixels) const {
  const LoadedSeriesPtr shown = this->shown();
  const ViewState& view = workspace.view(id());
  return flatPlane(view, flatLookOf(view), shown->volume->geometry(), crosshairOf(workspace, id(), *shown),
                   {pixels.width(), pixels.height()});
}

SeriesState FlatView::seriesState() const { return seriesStateIn(session_.workspace(), id()); }

void FlatView::askForPicture() {
  askForLens();
  const std::optional<SlicePlane> now = plane();
  if (!now || !isVisible() || now->size.x < 1 || now->size.y < 1) return;
  SliceRequest request = requestOf(*now);
  if (asked_ == request) return;
  asked_ = request;
  service_.request(std::move(request), session_.workspace().focus == id());
}

std::optional<SliceRequest> FlatView::requestFor(QSize pixels) const {
  std::optional<SlicePlane> now = plane();
  if (!now) return {};
  now->mmPerPixel *= double(now->size.x) / pixels.width();
  now->size = {pixels.width(), pixels.height()};
  return requestOf(*now);
}

QSize FlatView::ownPixels() const {
  const LoadedSeriesPtr shown = this->shown();
  if (!shown) return {};
  const glm::dvec2 size = wholeMm(state(), flatLookOf(state()), shown->volume->geometry()) / ownPixelMm();
  return {std::max(1, int(std::lround(size.x))), std::max(1, int(std::lround(size.y)))};
}

std::optional<SliceRequest> FlatView::requestForOwnPixels() const {
  if (!shown()) return {};
  SlicePlane whole = fittedPlane(session_.workspace(), ownPixels());
  whole.mmPerPixel = ownPixelMm();
  return requestOf(planeShown(whole));
}

QImage FlatView::capture() const {
  const std::optional<SliceRequest> wanted = requestFor(pixels());
  if (!wanted || drawn_ == wanted) return View::capture();
  const Result<QImage> drawn = drawSlice(*wanted);
  if (drawn) return captureWith(*drawn);
  return captureBy(pixels(), [this](QPainter& painter) { paintWith(painter, {}); });
}

QImage FlatView::captureWith(QImage picture) const {
  picture = std::move(picture).convertToFormat(QImage::Format_RGB32);
  captureOver(picture, [this](QPainter& painter) {
    if (shown()) paintOver(painter);
  });
  return picture;
}

// If frames of a clip come faster than they are drawn, any frame is better than none.
bool FlatView::mayShow(const SliceRequest& request) const {
  const bool isOfClip = request.frame && request.frame->key.series == state().series;
  return isOfClip || request.layers.front().volume == asked_->layers.front().volume;
}

bool FlatView::isAtRest() const { return asked_ && drawn_ == asked_ && !drag_; }

void FlatView::showPicture(const SlicePicture& picture) {
  if (picture.request.view != id() || !asked_ || !mayShow(picture.request)) return;
  if (picture.request.ofLens) {
    if (!lensAsked_) return;
    lens_ = picture;
    lens_->image.setDevicePixelRatio(devicePixelRatioF());
    return update();
  }
  picture_ = picture.image;
  drawn_ = picture.request;
  picture_.setDevicePixelRatio(devicePixelRatioF());
  update();
  if (isWanted(picture.request)) Q_EMIT settled();
  if (isPlaying() && picture.request.frame) cine_->tellShown(picture.request.frame->key.index);
}

void FlatView::forget() {
  picture_ = {};
  drawn_.reset();
  asked_.reset();
  tellWarnings();
}

void FlatView::tellWarnings() {
  const Warnings now = warnings();
  badge_->tell(now.words, now.sentences);
  placeBadge();
}

void FlatView::workspaceChanged(const Workspace&) {
  const std::pair now(state().series, state().kind);
  const auto last = std::exchange(showed_, now);
  if (last != now) {
    giveUpDrag();  // it belongs to the series shown before
    // A slice stays on screen until the slice of another time point is drawn.
    const bool isOneStack = last.second == now.second && showsSlices(now.second);
    if (!isOneStack || !areTimePointsIn(session_.workspace(), last.first, now.first)) forget();
  }
  if (last != now || !shown()) closeFields();
  ask();
  placeBadge();
  update();
}

void FlatView::placeBadge() {
  if (badge_->isHidden()) return;  // there is no warning
  const auto lines = shown() ? overlays().topLeft.size() : 0;
  badge_->move(8, 12 + int(lines) * (fontMetrics().height() + 1) + 4);
}

void FlatView::setTool(const Tool& tool) {
  if (isDrawing()) giveUpDrag();
  tool_ = &tool;
  update();
  tellPointed();
  setCursor(tool.cursor);
}

void FlatView::resetView() {
  if (state().series.empty() || !letGo()) return;
  Workspace after = session_.workspace();
  if (const LoadedSeriesPtr shown = this->shown(); shown && showsSlices(state().kind))
    if (const Crosshair before = crosshairOf(after, id(), *shown); before.byHand)
      after = withCrosshair(std::move(after), id(), frameOfReference(shown->series), before, {before.at});
  makeWhole(after.editView(id()).flats.editOrAdd(state().series));
  session_.change(tr("Reset view"), after);
  session_.endGesture();
}

// A drawing belongs to the plane at the press. Nothing else changes the plane while a button is held.
bool FlatView::letGo() {
  if (isDrawing()) giveUpDrag();
  return !drag_;
}

// Returns whether something is drawn that is not yet in the workspace.
bool FlatView::isDrawing() const { return drag_ && (drag_->drawing() || drag_->drawsOver()); }

void FlatView::showDrawing() {
  if (!isDrawing()) return;
  update();
  if (drag_->drawsInAll()) Q_EMIT drewInAll();
}

std::unique_ptr<Drag> FlatView::takeDrag() {
  std::unique_ptr<Drag> taken = std::move(drag_);
  if (taken && taken->drawsInAll()) Q_EMIT drewInAll();
  return taken;
}

void FlatView::giveUpDrag() {
  if (const auto given = takeDrag()) given->giveUp();
}

void FlatView::turnPicture(const QString& text, PictureTurn by) {
  if (!shown() || !letGo()) return;
  session_.endGesture();
  editFlat(session_, id(), text, [by](FlatLook& look) { turnFurther(look, by); });
  session_.endGesture();
}

void FlatView::zoomTo(double mmPerPixel) {
  const std::optional<SlicePlane> now = plane();
  if (!now || !letGo()) return;
  session_.endGesture();
  zoomFlat(session_, id(), flatLookOf(state()), *now, now->centre, now->mmPerPixel / mmPerPixel);
  session_.endGesture();
}

double FlatView::ownPixelMm() const {
  const VoxelGeometry& geometry = shown()->volume->geometry();
  const SlicePlane now = *plane();
  return std::min(voxelAlong(geometry, now.right), voxelAlong(geometry, now.down));
}

void FlatView::invert() {
  editFlat(session_, id(), tr("Invert"), [](FlatLook& look) { look.inverted = !look.inverted; });
  session_.endGesture();
}

std::optional<SlicePress> FlatView::pressAt(QPointF p) const {
  const std::optional<SlicePlane> now = plane();
  if (!now) return {};
  return SlicePress{
      session_, id(), shown(), *now, devicePixelRatioF(), p, windowShown().value_or(Window()), shapeFrame()};
}

bool FlatView::hasCursor() const {
  return showsSlices(state().kind) || (shown() && shown()->volume->geometry().calibrated);
}

void FlatView::setHighlights(const Highlights& highlights) {
  highlights_ = highlights;
  askForPicture();
  update();
}

void FlatView::makeThicker(int steps) {
  const LoadedSeriesPtr shown = this->shown();
  if (!shown || !showsSlices(state().kind) || steps == 0) return;
  const double step = wheelStep(shown->volume->geometry(), plane()->normal());
  editFlat(session_, id(), tr("Slab"), [&](FlatLook& look) {
    look.slabMm = std::clamp(std::round(look.slabMm / step + steps) * step, 0.0, 500.0);
  });
}

void FlatView::showEvent(QShowEvent* event) {
  View::showEvent(event);
  ask();
}

void FlatView::resizeEvent(QResizeEvent* event) {
  placeBadge();
  placeCineBar();
  View::resizeEvent(event);
}

}  // namespace volumen
