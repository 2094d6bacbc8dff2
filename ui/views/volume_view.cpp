#include "ui/views/volume_view.h"

#include <QToolButton>
#include <utility>

#include "results/text/series_text.h"
#include "results/text/text.h"
#include "ui/overlays/view_overlays.h"
#include "ui/views/canvas.h"
#include "ui/views/cine_bar.h"
#include "ui/widgets/orientation_cube.h"
#include "ui/widgets/plain_text.h"
#include "ui/widgets/warning_badge.h"
#include "ui/workspace/moved_cursors.h"
#include "viewer/scene/visible_range.h"

namespace volumen {

namespace {
constexpr int leastForCube = 280;  // pixels of width and height; in less the cube would hide the picture

// Returns "draft 1/4 - 12 ms", "final: standard - 223 ms". Old pictures have "before: standard - 223 ms".
QString captionOf(const ScreenPicture& drawn, bool isOld = false) {
  QString level = QString::fromLatin1(qualityName(drawn.quality));
  if (drawn.factor > 1) level += QStringLiteral(" 1/%1").arg(drawn.factor);
  if (drawn.atRest) level = (isOld ? VolumeView::tr("before: %1") : VolumeView::tr("final: %1")).arg(level);
  return VolumeView::tr("%1 - %2 ms").arg(level, QString::number(drawn.ms, 'f', drawn.ms < 10 ? 1 : 0));
}

QToolButton* makeTableButton(QWidget* parent) {
  auto* button = new QToolButton(parent);
  button->setObjectName(QStringLiteral("showTable"));
  button->setText(VolumeView::tr("Show table"));
  button->setToolTip(
      toolTipOf(VolumeView::tr("Table and cushions are left out of 3D pictures of CT: show them. 3D > Show "
                               "the table in 3D says so, too.")));
  button->setFocusPolicy(Qt::NoFocus);
  button->adjustSize();
  button->hide();
  return button;
}
}  // namespace

VolumeView::VolumeView(Session& session, const DrawnScenes& scenes, DrawService& drawService,
                       SegmentEditing* segments, ViewId id, QWidget* parent)
    : View(session, id, parent),
      scenes_(scenes),
      drawService_(drawService),
      segments_(segments),
      canvas_(makeCanvas([this](QPainter& p) { paintCanvas(p); }, [this] { replaceCanvas(); }, this)),
      cube_(new OrientationCube(this)),
      badge_(new WarningBadge(this)),
      showTable_(makeTableButton(this)),
      cine_(new CineBar(
          session, id, [this] { return isDrawn_; }, this)) {
  setObjectName(id == sceneViewId ? QStringLiteral("volumeView") : QStringLiteral("volumeView%1").arg(id));
  setAccessibleName(tr("Volume view"));
  wheelEnd_.setSingleShot(true);
  wheelEnd_.setInterval(500);
  connect(&wheelEnd_, &QTimer::timeout, this, [this] { session_.endGesture(); });
  connect(cube_, &OrientationCube::viewRequested, this, &VolumeView::showView);
  connect(this, &View::pixelsChanged, this, &VolumeView::requestPicture);
  connect(&drawService_, &DrawService::screenPictureReady, this, &VolumeView::showDrawn);
  connect(&session_, &Session::preferencesChanged, this, [this] {
    followDrawn(false);
    redraw();
    tellPointed();
  });
  // From the event loop, after the view has taken in the change that it follows from.
  connect(
      &scenes_, &DrawnScenes::changed, this, [this] { followDrawn(false); }, Qt::QueuedConnection);
  connect(showTable_, &QToolButton::clicked, this,
          [this] { session_.prefer([](Preferences& p) { p.tableIn3d = true; }); });
  // The zoom that is written depends on the undo steps.
  connect(&session_.undoStack(), &QUndoStack::indexChanged, this, [this] {
    if (series() && zoom() != placedZoom_) placed_.reset();
  });
  connect(cine_, &CineBar::shownChanged, this, [this] {
    placeChildren();
    redraw();
  });
  showWarnings();
  showState();
}

void VolumeView::seriesExchanged(bool another) {
  if (another) {
    fitMm_.clear();
    captionIfOld_.clear();
    pictureWarnings_.clear();
    setPicture({}, {});
  }
  if (another || !series()) letGo();
  showWarnings();
  showState();
}

void VolumeView::workspaceChanged(const Workspace& before) {
  const Workspace& now = session_.workspace();
  if (!movesCursorsAlone(before, now)) placed_.reset();
  const auto isOver = [&](const auto& drag) { return drag && !drag->goesOnIn(state().series); };
  if (isOver(drag_) || isOver(shape_)) letGo();
  if (before.focus != now.focus || before.crosshairs != now.crosshairs || before.layout != now.layout ||
      before.second != now.second || before.measurements != now.measurements ||
      before.selected != now.selected || before.measurementsShown != now.measurementsShown)
    canvas_->update();
  const ViewState& then = before.view(id());
  const auto look = then.scenes.find(state().series);
  const bool isNew = look == then.scenes.end();
  if (isNew || look->second.scene.camera != scene().camera) {
    if (drag_ && drag_->drawsOver()) letGo();
    showState();
  }
  followDrawn(isNew);
}

// Requests a picture if the session has another volume or scene to draw.
void VolumeView::followDrawn(bool isOtherLook) {
  const LoadedSeriesPtr drawn = scenes_.series(id());
  const VolumePtr volume = drawn ? drawn->volume : nullptr;
  const bool isAnother = std::exchange(drawn_, volume) != volume;
  if (isAnother) {
    isDrawn_ = false;
    const TissueLeft::Entry* tissue = scenes_.tissue(id());
    showTable_->setVisible(tissue && tissue->value->patient);
    placeChildren();
  }
  if (isAnother || (volume && (isOtherLook || drawnScene_ != sceneToDraw()))) requestPicture();
}

// Of the series, and of the picture.
std::vector<Warning> VolumeView::allWarnings() const {
  const LoadedSeriesPtr shown = series();
  std::vector<Warning> all = shown ? shown->warnings : std::vector<Warning>();
  if (shown) all.insert(all.end(), pictureWarnings_.begin(), pictureWarnings_.end());
  return all;
}

QStringList VolumeView::warningsShown() const {
  QStringList sentences;
  for (const Warning& w : changingPicture(allWarnings())) sentences << shownText(w.sentence);
  return sentences;
}

void VolumeView::showWarnings() {
  QStringList words;
  for (const std::string& text : shortWarnings(allWarnings())) words << QString::fromStdString(text);
  badge_->tell(words, warningsShown());
  placeChildren();
}

void VolumeView::showState() {
  const bool directions = series() && knowsSides(series()->series);
  cube_->setVisible(directions && width() >= leastForCube && height() >= leastForCube);
  if (series()) cube_->setAxes(cameraAxes(camera()));
  redraw();
}

void VolumeView::replaceCanvas() {
  canvas_->deleteLater();
  canvas_ = makeRasterCanvas([this](QPainter& p) { paintCanvas(p); }, this);
  canvas_->lower();
  canvas_->show();
  placeChildren();
}

void VolumeView::placeChildren() {
  canvas_->setGeometry(rect());
  cine_->setGeometry(0, height() - CineBar::barHeight, width(), CineBar::barHeight);
  cube_->move(8, int(overlayArea().bottom()) - cube_->height() - 8);
  // The badge stands below the lines about patient and series.
  const auto lines = series() ? overlays().topLeft.size() : 0;
  badge_->move(8, 12 + int(lines) * (fontMetrics().height() + 1) + 4);
  showTable_->move(8, badge_->y() + (badge_->isHidden() ? 0 : badge_->height() + 4));
}

const QImage& VolumeView::shown() const {
  return errorShown_ && !errorImage_.image.isNull() ? errorImage_.image : picture_;
}

void VolumeView::setErrorShown(bool shown) {
  errorShown_ = shown;
  makeErrorImage();
  redraw();
}

void VolumeView::makeErrorImage() {
  errorImage_ = {};
  if (!errorShown_) return;
  errorImage_ = errorImage(error_ ? *error_ : std::vector<float>(), picture_.size());
  errorImage_.image.setDevicePixelRatio(picture_.devicePixelRatio());
}

void VolumeView::requestPicture() {
  const LoadedSeriesPtr shown = scenes_.series(id());
  const bool isShown = shown && isVisible() && showsScene(state().kind);
  drawService_.show(id(), isShown ? shown->volume : nullptr);
  const Scene before = std::exchange(drawnScene_, sceneToDraw());
  if (!isShown) return;
  if (!isDrawn_ || before != drawnScene_ || picture_.size() != pixels()) showOld();
  numberAsked_ = drawService_.request(id(), drawnScene_, pixels());
}

// The picture stays until the next one but no longer counts as final.
void VolumeView::showOld() {
  if (captionIfOld_.isEmpty() || caption_ == captionIfOld_) return;
  caption_ = captionIfOld_;
  redraw();
}

void VolumeView::showOnly(const std::optional<VolumeRange>& range) {
  only_ = range;
  if (drawn_ && drawnScene_ != sceneToDraw()) requestPicture();
}

Scene VolumeView::sceneToDraw() const {
  Scene scene = scenes_.scene(id());
  const LoadedSeriesPtr shown = series();
  if (only_ && (only_->volume == drawn_ || (shown && only_->volume == shown->volume)))
    scene.transferFunction = restrictedTo(scene.transferFunction, only_->range);
  return scene;
}

void VolumeView::togglePlay() { cine_->togglePlay(); }

void VolumeView::showDrawn(const ScreenPicture& picture) {
  if (picture.view != id()) return;
  isDrawn_ = true;
  numberDrawn_ = picture.number;
  if (std::exchange(pictureWarnings_, picture.warnings) != picture.warnings) showWarnings();
  setPicture(picture.image, captionOf(picture), picture.error);
  captionIfOld_ = captionOf(picture, true);
  Q_EMIT drawn(picture);
}

void VolumeView::setPicture(const QImage& image, const QString& caption,
                            std::shared_ptr<const std::vector<float>> error) {
  picture_ = image;
  picture_.setDevicePixelRatio(devicePixelRatioF());
  caption_ = caption;
  error_ = std::move(error);
  makeErrorImage();
  redraw();
  // Texts of measurements make room for the caption.
  if (!drawnMeasurements().empty()) tellPointed();
}

void VolumeView::setTool(const Tool& tool) {
  tool_ = &tool;
  letGo();
  setCursor(drawing_ ? drawing_->cursor : tool.cursor);
}

Camera VolumeView::camera() const { return cameraInUse(scene(), series()->volume->geometry(), size()); }

std::optional<Pick> VolumeView::pickAt(QPointF position) const {
  if (!series()) return {};
  const Camera seen = camera();
  return pick(scenes_.scene(id()), *scenes_.series(id())->volume,
              sightLine(seen, size(), glm::dvec2(position.x(), position.y())),
              seen.projection == Projection::parallel);
}

void VolumeView::editCamera(const QString& what, const Camera& camera) {
  const std::optional<Camera> before = scene().camera;
  const Camera fitted = this->camera();
  session_.edit(
      id(), what, [&](Scene& s) { s.camera = camera; }, what);
  if (!before) rememberFit(fitted);
}

void VolumeView::rememberFit(const Camera& fitted) {
  const int step = session_.undoStack().index();
  fitMm_.erase(fitMm_.upper_bound(step), fitMm_.end());
  fitMm_[step] = heightAtTarget(fitted);
  placed_.reset();
}

double VolumeView::zoom() const {
  if (!series() || !scene().camera) return 1;
  const Camera seen = camera();
  const auto after = fitMm_.upper_bound(session_.undoStack().index());
  if (after != fitMm_.begin()) return std::prev(after)->second / heightAtTarget(seen);
  const Camera first = series()->firstScene.camera.value_or(Camera{});
  const Camera fitted = fitCamera(first, series()->volume->geometry(), double(width()) / height());
  return heightAtTarget(fitted) / heightAtTarget(seen);
}

void VolumeView::showView(const QString& name) {
  if (!series()) return;
  Camera view = *standardView(name.toStdString());
  const Camera now = camera();
  view.fov = now.fov;
  view.projection = now.projection;
  session_.endGesture();
  view = fitCamera(view, series()->volume->geometry(), double(width()) / height());
  editCamera(viewText(name), view);
  rememberFit(view);
  session_.endGesture();
}

void VolumeView::resetView() {
  session_.edit(id(), tr("Reset view"), [](Scene& s) { s.camera.reset(); });
}

void VolumeView::showEvent(QShowEvent* event) {
  View::showEvent(event);
  requestPicture();
}

void VolumeView::hideEvent(QHideEvent* event) {
  View::hideEvent(event);
  cine_->stop();
  letGo();
  requestPicture();
}

void VolumeView::enterEvent(QEnterEvent* event) {
  View::enterEvent(event);
  drawService_.setGestureView(id());
}

void VolumeView::resizeEvent(QResizeEvent* event) {
  if (drag_ && drag_->drawsOver()) letGo();
  placeChildren();
  showState();
  View::resizeEvent(event);
}

}  // namespace volumen
