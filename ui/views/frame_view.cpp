#include "ui/views/frame_view.h"

#include <QPainter>
#include <utility>

#include "io/study/frame_series.h"
#include "results/pictures/paint_graphics.h"
#include "results/series/loaded_frame.h"
#include "results/text/series_text.h"
#include "results/text/text.h"
#include "ui/controller/derived_objects.h"
#include "ui/overlays/view_overlays.h"
#include "ui/views/cine_bar.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/frame_look.h"
#include "ui/workspace/frame_text.h"
#include "ui/workspace/presented_frame.h"
#include "ui/workspace/view_window.h"

namespace volumen {

namespace {

QString letters(glm::dvec3 direction) { return QString::fromStdString(sideLetters(direction)); }

}  // namespace

// Skips frames that come faster than they are read. Playback is no undo step until it stops.
class FrameView::Clip : public Playable {
 public:
  explicit Clip(FrameView& view) : view_(view) {}

  Stack stack() const override { return series() ? framesIn(*series(), view_.frameKey().index) : Stack(); }
  SeriesKey source() const override { return view_.state().series; }
  Cine cine() const override { return series()->cine; }
  bool isClip() const override {
    const Series& clip = *series();
    return frameCount(clip) > 1 && (clip.cine.framesPerSecond > 0 || !clip.cine.frameTimesMs.empty() ||
                                    clip.files.front() == clip.files.back());
  }
  void goTo(int place) override { view_.moveTo(place); }
  void play(int place) override {
    view_.played_ = place;
    view_.askForFrame();
  }
  bool isReady(int) const override { return true; }
  bool keepsTime() const override { return true; }
  // Stops at the frame on screen.
  void stop() override {
    if (!view_.played_) return;
    const int frame = view_.frame_ ? view_.frame_->key.index : *view_.played_;
    view_.played_.reset();
    view_.session_.endGesture();
    editFlat(view_.session_, view_.id(), tr("Play"), [&](FlatLook& look) { look.frame = frame; });
    view_.session_.endGesture();
    view_.update();
  }
  void giveUp() override {
    view_.played_.reset();
    view_.ask();
  }

 private:
  // Null if the view shows no frames.
  const Series* series() const {
    return view_.isCurrent() ? seriesIn(view_.session_.workspace(), view_.id()) : nullptr;
  }

  FrameView& view_;
};

FrameView::FrameView(const ViewParts& parts, ViewId id, QWidget* parent)
    : FlatView(parts, id, parent), frames_(parts.frames) {
  setObjectName(QStringLiteral("frameView%1").arg(id));
  connect(&frames_, &FrameService::ready, this, &FrameView::takeFrame);
  connect(&frames_, &FrameService::failed, this, &FrameView::tellFailure);
  retry_.setSingleShot(true);
  connect(&retry_, &QTimer::timeout, this, &FrameView::askForFrame);
  connect(&frames_, &FrameService::progressed, this, [this](const FrameKey& key, int percent) {
    if (isLoading() && key == frameKey()) setPercentRead(percent);
  });
  connect(&frames_, &FrameService::held, this, [this](const SeriesKey& series) {
    if (isCurrent() && series == state().series) update();
  });
  cine_->add(std::make_unique<Clip>(*this), true);
  tellWarnings();
}

FrameView::~FrameView() = default;

FrameKey FrameView::frameKey() const {
  if (state().series.empty()) return {};
  const int last = std::max(0, frameCount(*seriesState().series) - 1);
  const FlatLook look = flatLookOf(state());
  return {state().series, played_.value_or(std::min(look.frame, last)), look.presentation.path};
}

void FrameView::forget() {
  if (std::exchange(played_, {})) stop();
  frame_.reset();
  failure_.clear();
  if (!isCurrent()) frames_.drop(id());
  FlatView::forget();
}

void FrameView::ask() {
  askForFrame();
  askForPicture();
  showWaiting();
}

// Clips drop frames that are not read in time.
bool FrameView::isLoading() const {
  if (!isCurrent() || state().series.empty() || isPlaying() || !failure_.isEmpty()) return false;
  const SeriesState series = seriesState();
  const bool isHere = !series.missing && frameCount(*series.series) > 0;
  return isHere && !(frame_ && frame_->key == frameKey());
}

void FrameView::askForFrame() {
  if (!isCurrent() || state().series.empty() || !isVisible()) return;
  if (frameCount(*seriesState().series) == 0) return;  // the session's files are missing
  const FrameKey key = frameKey();
  if (frame_ && frame_->key == key) return;
  if (std::exchange(awaited_, key) != key) setPercentRead({});
  const bool isBackwards = isPlaying() ? cine_->isBackwards() : frame_ && frame_->key.index > key.index;
  frames_.request(id(), seriesState().series, key.index, isBackwards ? -1 : 1, key.presentation);
  if (const LoadedFramePtr held = frames_.find(key)) takeFrame(id(), held);
}

void FrameView::takeFrame(int view, const LoadedFramePtr& frame) {
  if (view != id() || !isCurrent() || frame->key.series != state().series) return;
  const FrameKey wanted = frameKey();
  if (frame_ && frame_->key == wanted && frame->key != wanted) return;
  frame_ = frame;
  failure_.clear();
  tellWarnings();
  askForPicture();
  showWaiting();
  cine_->look();
  tellPointed();
}

void FrameView::tellFailure(int view, const FrameKey& key, const QString& sentence) {
  // A clip continues with the next frame.
  if (view != id() || !isCurrent() || isPlaying() || key != frameKey()) return;
  // Twice as long after each further failure.
  retry_.start(failure_.isEmpty() ? FrameService::tryAgainMs
                                  : std::min(2 * retry_.interval(), 64 * FrameService::tryAgainMs));
  forget();
  failure_ = shownText(sentence.toStdString());
  showWaiting();
  update();
  tellPointed();
  Q_EMIT settled();
}

bool FrameView::isWanted(const SliceRequest& request) const {
  return frame_ && frame_->key == frameKey() && FlatView::isWanted(request);
}

SlicePlane FrameView::planeShown(const SlicePlane& plane) const {
  return frame_->how ? presentedPlane(*frame_, flatLookOf(state()), plane) : plane;
}

SliceRequest FrameView::requestOf(const SlicePlane& plane) const {
  const FlatLook look = flatLookOf(state());
  const SliceLayer layer{frame_->slice->volume, frameGrey(seriesState(), look, *frame_),
                         seriesState().colours};
  return {id(), {layer}, plane, frame_, look.layers, segmentLayers()};
}

std::optional<Window> FrameView::windowShown() const {
  if (!shown() || frame_->colour()) return {};
  const SeriesState series = seriesState();
  return series.window.value_or(frameGrey(series, flatLookOf(state()), *frame_).window);
}

FlatView::Warnings FrameView::warnings() const {
  Warnings warnings;
  for (const std::string& sentence : frame_ ? frame_->warnings : std::vector<std::string>{})
    warnings.sentences << shownText(sentence);
  if (!warnings.sentences.isEmpty()) warnings.words << tr("Not all as the file says");
  return warnings;
}

Stack FrameView::stack() const {
  if (!isCurrent() || state().series.empty()) return {};
  Stack stack = framesIn(*seriesState().series, frame_ ? frame_->key.index : flatLookOf(state()).frame);
  if (!frame_) stack.seen = {};
  return stack;
}

std::optional<StackBar> FrameView::stackBar() const {
  std::optional<StackBar> bar = FlatView::stackBar();
  if (bar) bar->held = runsOf(frames_.heldOf(state().series, frameKey().presentation));
  return bar;
}

std::vector<FlatView::WindowChoice> FrameView::windows() const {
  std::vector<WindowChoice> all;
  if (!shown()) return all;
  for (const GreyChoice& choice : greyChoices(*frame_, seriesState(), session_.preferences().windows))
    all.push_back({choice.name,
                   withGrey(seriesState(), choice) == seriesState(),
                   choice.key,
                   {choice.window, choice.namedGrey}});
  return all;
}

void FrameView::hideEvent(QHideEvent* event) {
  played_.reset();
  frames_.drop(id());
  FlatView::hideEvent(event);
}

QString FrameView::hoverText(QPointF position) const {
  const auto press = pressAt(position);
  if (!press) return {};
  const glm::dvec3 p = press->patientAt(position);
  const VoxelGeometry& geometry = frame_->geometry();
  const glm::ivec2 pixel(glm::floor(glm::dvec2(geometry.voxelFromPatient(p)) + 0.5));
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= geometry.size.x || pixel.y >= geometry.size.y) return {};
  const QString place = geometry.calibrated ? placeText(p) : pixelPlaceText(*frame_, pixel);
  return tr("%1 at %2").arg(pixelValueText(*frame_, pixel), place);
}

Overlays FrameView::overlays() const {
  const Series& series = *seriesState().series;
  const SlicePlane now = *plane();
  const FlatLook look = flatLookOf(state());
  CornerTexts texts = seriesCorner(series, frame_->key.index);
  const QString number = tr("Frame %1 / %2").arg(frame_->key.index + 1).arg(frameCount(series));
  const double rate = cine_->rate();
  texts.add(CornerItem::plane, rate > 0 ? tr("%1, %2 a second").arg(number).arg(rate, 0, 'f', 1) : number);
  if (series.notVolume.empty()) texts.add(CornerItem::thickness, thicknessText(series));
  texts.add(CornerItem::step, stepText(session_.workspace(), state().series));
  texts.add(CornerItem::pixelSize, pixelSizeText(*frame_));
  texts.add(CornerItem::mark, lossyText(series));
  texts.add(CornerItem::turn, turnText(look.turn));
  texts.add(CornerItem::mark, QStringList{presentationText(), keyImageText()});
  Overlays o = cornersOf(texts);
  o.number = texts.text(CornerItem::plane);
  o.isLate = cine_->isLate();
  o.lengthsWord = QLatin1String(pixelSizeWord(frame_->pixel.kind));
  o.bottomRight = windowLine(greyText(seriesState(), look, *frame_, session_.preferences().windows));
  o.warning = failure_;
  if (hasMm(*frame_)) o.mmPerPixel = now.mmPerPixel * devicePixelRatioF();
  const auto side = [&](glm::dvec3 direction) {
    return frame_->geometry().calibrated ? letters(direction)
                                         : QString::fromStdString(frameSide(*frame_, direction));
  };
  o.right = side(now.right);
  o.left = side(-now.right);
  o.bottom = side(now.down);
  o.top = side(-now.down);
  return o;
}

QString FrameView::presentationText() const {
  if (!frame_->how) return {};
  const auto states = derived_.naming(DerivedKind::presentation, *seriesState().series, frame_->key.index);
  const DerivedKey chosen = flatLookOf(state()).presentation;
  const auto is = [&](const DerivedObjectPtr& object) { return keyOf(*object) == chosen; };
  const auto found = std::ranges::find_if(states, is);
  const QString label = found == states.end() ? QString() : shownText((*found)->label);
  return label.isEmpty() ? tr("Presentation state") : tr("Presentation %1").arg(label);
}

// Paints the graphics of a presentation state.
void FrameView::paintLines(QPainter& painter) const {
  FlatView::paintLines(painter);
  if (!frame_->how || !flatLookOf(state()).layers) return;
  const double ratio = devicePixelRatioF();
  const SlicePlane now = *plane();
  painter.save();
  const Overlays corners = overlays();
  const PlacedOverlays placed = placeOverlays(corners, overlayArea(), painter.font());
  std::vector<QRectF> taken = corners.taken;
  for (const PlacedText& text : placed.texts) taken.push_back(text.rect);
  if (!placed.scaleBar.isEmpty()) taken.push_back(placed.scaleBar);
  paintGraphics(
      painter, *frame_->how,
      [&](glm::dvec2 position, AnnotationUnits units) {
        const glm::dvec2 p = now.pixelFromPatient(annotationPlace(*frame_, position, units)) / ratio;
        return QPointF(p.x, p.y);
      },
      std::move(taken));
  painter.restore();
}

}  // namespace volumen
