#include "ui/data/frame_series.h"
#include "ui/overlays/view_overlays.h"
#include "ui/views/cine_player.h"
#include "ui/views/slice_view.h"
#include "ui/views/time_bar.h"
#include "ui/widgets/warning_badge.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/corner_text.h"
#include "ui/workspace/frame_text.h"
#include "ui/workspace/presented_frame.h"
#include "ui/workspace/series_text.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

QString letters(glm::dvec3 direction) { return QString::fromStdString(sideLetters(direction)); }

}  // namespace

FrameKey SliceView::frameKey() const {
  if (state().series.empty()) return {};
  const int last = std::max(0, frameCount(*seriesState().series) - 1);
  const FlatLook look = flatLookOf(state());
  return {state().series, player_ ? player_->due() : std::min(look.frame, last), look.presentation.path};
}

void SliceView::forgetFrame() {
  player_.reset();
  frame_.reset();
  frameFailure_.clear();
  picture_ = {};
  asked_.reset();
  if (!showsFrames()) frames_.drop(id());
  tellWarnings();
}

void SliceView::askForFrame() {
  if (!showsFrames() || state().series.empty() || !isVisible()) return;
  if (frameCount(*seriesState().series) == 0) return;  // of a session whose files are not here
  const FrameKey key = frameKey();
  if (frame_ && frame_->key == key) return;
  const bool isBackwards = frame_ && frame_->key.index > key.index && !player_;
  frames_.request(id(), seriesState().series, key.index, isBackwards ? -1 : 1, key.presentation);
  if (const ShownFramePtr held = frames_.find(key)) takeFrame(id(), held);
}

void SliceView::takeFrame(int view, const ShownFramePtr& frame) {
  if (view != id() || !showsFrames() || frame->key.series != state().series) return;
  const FrameKey wanted = frameKey();
  if (frame_ && frame_->key == wanted && frame->key != wanted) return;
  frame_ = frame;
  frameFailure_.clear();
  tellWarnings();
  askForPicture();
  tellPointed();
}

void SliceView::tellFrameFailure(int view, const FrameKey& key, const QString& sentence) {
  // A clip goes on with the next one.
  if (view != id() || !showsFrames() || player_ || key != frameKey()) return;
  forgetFrame();
  frameFailure_ = shownText(sentence.toStdString());
  update();
  tellPointed();
}

StackPlace SliceView::place() const {
  const ShownSeriesPtr shown = this->shown();
  if (!shown) return {};
  if (showsFrames()) return {frame_->key.index, frameCount(*seriesState().series)};
  return stackPlace(shown->volume->geometry(), state().kind, crosshairOf(session_.workspace(), id(), *shown));
}

void SliceView::togglePlay() {
  if (player_) return stop();
  if (!showsFrames()) return time_->togglePlay();
  if (state().series.empty()) return;
  const Series& series = *seriesState().series;
  if (frameCount(series) < 2) return;
  player_ = std::make_unique<CinePlayer>(series.cine, frameCount(series), flatLookOf(state()).frame);
  connect(player_.get(), &CinePlayer::frameDue, this, &SliceView::askForFrame);
}

// At the frame on screen: one step, however long the clip was played.
void SliceView::stop() {
  if (!player_) return;
  const int frame = frame_ ? frame_->key.index : player_->due();
  player_.reset();
  session_.endGesture();
  editFlat(session_, id(), tr("Play"), [&](FlatLook& look) { look.frame = frame; });
  session_.endGesture();
  update();
}

void SliceView::invert() {
  editFlat(session_, id(), tr("Invert"), [](FlatLook& look) { look.inverted = !look.inverted; });
  session_.endGesture();
}

void SliceView::chooseGrey(const GreyChoice& choice) {
  session_.change(tr("Window"), [&](Workspace& w) {
    SeriesState& state = w.series.edit(this->state().series);
    state = withGrey(state, choice);
  });
}

void SliceView::hideEvent(QHideEvent* event) {
  player_.reset();
  frames_.drop(id());
  View::hideEvent(event);
}

QString SliceView::frameHoverText(QPointF position) const {
  const glm::dvec3 p = pressAt(position)->patientAt(position);
  const VoxelGeometry& geometry = frame_->geometry();
  const glm::ivec2 pixel(glm::floor(glm::dvec2(geometry.voxelFromPatient(p)) + 0.5));
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= geometry.size.x || pixel.y >= geometry.size.y) return {};
  const QString place =
      geometry.calibrated ? placeText(*seriesState().series, p) : pixelPlaceText(*frame_, pixel);
  return tr("%1 at %2").arg(pixelValueText(*frame_, pixel), place);
}

Overlays SliceView::frameOverlays() const {
  const Series& series = *seriesState().series;
  const SlicePlane now = *plane();
  const FlatLook look = flatLookOf(state());
  CornerTexts texts = seriesCorner(series);
  Overlays o;
  QString title = tr("Frame %1 / %2").arg(place().index + 1).arg(place().count);
  if (player_ && player_->rate() > 0) {
    title += tr(", %1 a second").arg(player_->rate(), 0, 'f', 1);
    o.isLate = player_->isLate();
  }
  texts.add(CornerItem::plane, title);
  if (series.notVolume.empty()) texts.add(CornerItem::thickness, thicknessText(series));
  texts.add(CornerItem::step, stepText(session_.workspace(), state().series));
  texts.add(CornerItem::pixelSize, pixelSizeText(*frame_));
  texts.add(CornerItem::mark, lossyText(series));
  texts.add(CornerItem::mark, referenceTexts());
  const int lines = cornerLines(overlayArea(), font());
  o.topLeft = texts.left(lines);
  o.topRight = texts.right(lines);
  o.bottomRight = greyText(seriesState(), look, *frame_);
  o.warning = frameFailure_;
  if (badge_->isVisibleTo(this)) o.taken.push_back(badge_->geometry());
  if (hasMm(*frame_)) o.mmPerPixel = now.mmPerPixel * devicePixelRatioF();
  const auto side = [&](glm::dvec3 direction) {
    if (!frame_->geometry().calibrated) return QString::fromStdString(frameSide(*frame_, direction));
    return knowsSides(series) ? letters(direction) : QString();
  };
  o.right = side(now.right);
  o.left = side(-now.right);
  o.bottom = side(now.down);
  o.top = side(-now.down);
  return o;
}

}  // namespace volumen
