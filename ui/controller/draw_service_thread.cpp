// The render thread of DrawService.
#include <algorithm>

#include "ui/controller/draw_service.h"

namespace volumen {

namespace {

// Pause without new requests before the full picture is begun.
constexpr std::chrono::milliseconds restTime{25};
// Interval of checks for idle voxels, because nothing signals when the last holder of a volume releases it.
constexpr std::chrono::seconds lookTime{1};

}  // namespace

void DrawService::run() {
  std::unique_lock lock(mutex_);
  while (const auto turn = waitForTurn(lock)) {
    switch (turn->work) {
      case Work::draft:
        drawDraft(turn->view, lock);
        break;
      case Work::finer:
        drawFiner(turn->view, lock);
        break;
      case Work::rest:
        drawRest(turn->view, lock);
        break;
      case Work::saved:
        drawSaved(lock);
        break;
      case Work::trial:
        drawTrial(lock);
        break;
      case Work::thumbnail:
        drawThumbnail(lock);
        break;
    }
  }
  drawings_.clear();  // on this thread, which owns their OpenGL contexts
  pool_->count(this, 0);
}

std::optional<Turn> DrawService::waitForTurn(std::unique_lock<std::mutex>& lock) {
  while (true) {
    dropUnused(lock);
    if (closing_) return {};
    if (const auto turn = nextTurn(waiting())) return turn;
    if (pool_->hasIdle())
      wake_.wait_for(lock, lookTime);
    else
      wake_.wait(lock);
  }
}

// Drops the drawings of views that are hidden or show another volume, and the data of volumes that are gone.
void DrawService::dropUnused(std::unique_lock<std::mutex>& lock) {
  std::vector<ViewId> unused;
  for (const auto& [id, drawing] : drawings_)
    if (drawing.shownAt() != views_.at(id).shownAt) unused.push_back(id);
  lock.unlock();
  for (const ViewId id : unused) drawings_.erase(id);
  pool_->dropUnheld();
  std::size_t bytes = 0;
  for (const auto& [id, drawing] : drawings_)
    if (drawing.draw().bytes) bytes += drawing.draw().bytes();
  pool_->count(this, bytes);
  lock.lock();
}

Waiting DrawService::waiting() const {
  Waiting all{{}, gestureView_, !pictures_.empty(), trial_.has_value(), thumbnails_.has_value()};
  for (const auto& [id, view] : views_)
    if (view.pending)
      all.views.push_back(
          {id, view.pending->next,
           std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - view.pending->since)});
  return all;
}

void DrawService::drawDraft(ViewId id, std::unique_lock<std::mutex>& lock) {
  View& view = views_.at(id);
  view.pending->since = Clock::now();
  const ScreenRequest request = view.pending->request;
  const VolumePtr volume = view.volume;
  const int shownAt = view.shownAt;
  const CancelToken cancel = view.cancel;
  lock.unlock();
  ViewDrawing& drawing = drawingOf(id, volume, shownAt);
  const Pass draft = drawing.draftPass(request.level);
  const bool only = draft == restPass(request.level);
  // Another quality level of the picture on screen needs no draft; that picture may be finer than any draft.
  const bool seen = drawing.isSeen(request) && !only;
  const Outcome outcome = seen ? Outcome::drawn : drawScreen(id, request, draft, only, cancel);
  const auto finerFactor = seen ? std::nullopt : drawing.factorOfFiner(request.level);
  quietAt_ = Clock::now() + restTime;
  lock.lock();
  if (only)
    follow(id, request.number, outcome, {});
  else
    follow(id, request.number, outcome, finerFactor ? Work::finer : Work::rest, finerFactor.value_or(1));
}

void DrawService::drawFiner(ViewId id, std::unique_lock<std::mutex>& lock) {
  View& view = views_.at(id);
  const ScreenRequest request = view.pending->request;
  const Pass pass{Quality::draft, view.pending->finerFactor};
  if (!staysQuiet(id, request.number, lock)) return;
  const CancelToken cancel = view.restCancel = CancelToken();
  lock.unlock();
  const Outcome outcome = drawScreen(id, request, pass, false, cancel);
  lock.lock();
  follow(id, request.number, outcome, Work::rest);
}

void DrawService::drawRest(ViewId id, std::unique_lock<std::mutex>& lock) {
  View& view = views_.at(id);
  const ScreenRequest request = view.pending->request;
  const CancelToken cancel = view.restCancel = CancelToken();
  lock.unlock();
  const Pass pass = restPass(request.level);
  const ViewDrawing& drawing = drawings_.at(id);
  const PlannedPass ahead = planPass(drawing.draw(), *drawing.volume(), request, pass, quietAt_, cancel);
  lock.lock();
  if (!staysQuiet(id, request.number, lock)) return;
  lock.unlock();
  const Outcome outcome = drawScreen(id, request, pass, true, cancel, &ahead);
  lock.lock();
  follow(id, request.number, outcome, {});
}

void DrawService::drawSaved(std::unique_lock<std::mutex>& lock) {
  const PictureRequest request = std::move(pictures_.front());
  pictures_.pop_front();
  pictureCancel_ = request.cancel;
  lock.unlock();
  Result<Drawn> drawn = drawOf(request.volume)(request.scene, request.options, request.cancel);
  const auto saved = drawn ? std::make_shared<Drawn>(std::move(*drawn)) : nullptr;
  const QString failure = saved                        ? QString()
                          : request.cancel.cancelled() ? tr("Cancelled.")
                                                       : QString::fromStdString(drawn.message());
  QMetaObject::invokeMethod(
      this, [this, number = request.number, saved, failure] { Q_EMIT pictureReady(number, saved, failure); },
      Qt::QueuedConnection);
  lock.lock();
  pictureCancel_ = CancelToken();
}

// The request stays open if another task interrupts it.
void DrawService::drawTrial(std::unique_lock<std::mutex>& lock) {
  const auto [volume, request] = *trial_;
  const CancelToken cancel = trialCancel_ = CancelToken();
  lock.unlock();
  Result<DrawnPass> drawn = drawPass(drawOf(volume), *volume, request, restPass(request.level), cancel);
  lock.lock();
  if (cancel.cancelled()) return;
  trial_.reset();
  Trial trial{request.number, request.level, request.pixels, 0, nullptr, {}};
  if (drawn) {
    trial.ms = drawn->shown.ms - drawn->shown.stats.gradientsMs;
    trial.drawn = std::make_shared<const Drawn>(std::move(drawn->drawn));
  } else {
    trial.failure = QString::fromStdString(drawn.message());
  }
  QMetaObject::invokeMethod(
      this, [this, trial] { Q_EMIT trialReady(trial); }, Qt::QueuedConnection);
}

// Draws one at a time, so that other tasks come in between. An interrupted thumbnail is drawn again.
void DrawService::drawThumbnail(std::unique_lock<std::mutex>& lock) {
  const VolumePtr volume = thumbnails_->volume;
  const Scene scene = thumbnails_->scenes[thumbnails_->next];
  const int batch = thumbnailBatch_, n = int(thumbnails_->next);
  RenderOptions options;
  options.size = {thumbnails_->pixels.width(), thumbnails_->pixels.height()};
  options.quality = Quality::draft;
  const CancelToken cancel = trialCancel_ = CancelToken();
  lock.unlock();
  const Result<Drawn> drawn = drawOf(volume)(scene, options, cancel);
  const QImage image = drawn ? toImage(drawn->picture) : QImage();
  lock.lock();
  if (cancel.cancelled() || batch != thumbnailBatch_) return;
  if (++thumbnails_->next == thumbnails_->scenes.size()) thumbnails_.reset();
  if (!drawn) return;
  QMetaObject::invokeMethod(
      this, [this, batch, n, image] { Q_EMIT thumbnailReady(batch, n, image); }, Qt::QueuedConnection);
}

// Returns the drawing of this volume in a view, for this call of show().
ViewDrawing& DrawService::drawingOf(ViewId id, const VolumePtr& volume, int shownAt) {
  const auto found = drawings_.find(id);
  if (found != drawings_.end() && found->second.shownAt() == shownAt) return found->second;
  drawings_.erase(id);
  return drawings_.try_emplace(id, volume, shownAt, makeDraw_(pool_->voxelsOf(volume))).first->second;
}

// Returns the draw functions of a volume without a view: those of a view that shows it, else new ones.
Draw DrawService::drawOf(const VolumePtr& volume) {
  const auto shown = std::find_if(drawings_.begin(), drawings_.end(),
                                  [&](const auto& entry) { return entry.second.volume() == volume; });
  return shown != drawings_.end() ? shown->second.draw() : makeDraw_(pool_->voxelsOf(volume));
}

DrawService::Outcome DrawService::drawScreen(ViewId id, const ScreenRequest& request, Pass pass, bool atRest,
                                             const CancelToken& cancel, const PlannedPass* ahead) {
  ViewDrawing& drawing = drawings_.at(id);
  Result<DrawnPass> drawn = drawPass(drawing.draw(), *drawing.volume(), request, pass, cancel, ahead);
  if (!drawn) {
    if (cancel.cancelled()) return Outcome::cancelled;
    const bool again = request.resampler == Resampler::gl && pass.quality != Quality::draft;
    QMetaObject::invokeMethod(
        this,
        [this, id, number = request.number, sentence = QString::fromStdString(drawn.message()), again] {
          deliverFailure(id, number, sentence, !again);
        },
        Qt::QueuedConnection);
    if (!again) return Outcome::failed;
    useCpu();
    ScreenRequest byCpu = request;
    byCpu.resampler = Resampler::cpu;
    return drawScreen(id, byCpu, pass, atRest, cancel);
  }
  ScreenPicture& picture = drawn->shown;
  picture.view = id;
  picture.volume = drawing.volume();
  picture.atRest = atRest;
  drawing.drew(picture, request);
  QMetaObject::invokeMethod(
      this, [this, picture] { deliver(picture); }, Qt::QueuedConnection);
  return Outcome::drawn;
}

// Waits for the pause without new requests. Returns false if a request came.
bool DrawService::staysQuiet(ViewId id, int number, std::unique_lock<std::mutex>& lock) {
  const auto& pending = views_.at(id).pending;
  return !wake_.wait_until(lock, quietAt_, [&] {
    return closing_ || !pending || pending->request.number != number ||
           std::any_of(views_.begin(), views_.end(), [](const auto& entry) {
             return entry.second.pending && entry.second.pending->next == Work::draft;
           });
  });
}

// Sets the next task of a view after a picture, unless the view has another request by now.
void DrawService::follow(ViewId id, int number, Outcome outcome, std::optional<Work> next,
                         double finerFactor) {
  auto& pending = views_.at(id).pending;
  if (outcome == Outcome::cancelled || !pending || pending->request.number != number) return;
  if (outcome == Outcome::failed || !next) return pending.reset();
  pending->next = *next;
  pending->finerFactor = finerFactor;
}

// OpenGL has failed; pending requests use the CPU.
void DrawService::useCpu() {
  const std::lock_guard lock(mutex_);
  resampler_ = Resampler::cpu;
  for (auto& [id, view] : views_)
    if (view.pending) view.pending->request.resampler = Resampler::cpu;
}

}  // namespace volumen
