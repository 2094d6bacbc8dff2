#include "ui/controller/render_controller.h"

#include <algorithm>
#include <chrono>

#include "viewer/scene/first_camera.h"

namespace volumen {

namespace {

using Clock = std::chrono::steady_clock;

// How long nothing new must be asked for before the full picture is begun.
constexpr std::chrono::milliseconds restTime{25};

}  // namespace

Result<Drawn> Draw::operator()(const Scene& scene, const RenderOptions& options,
                               const CancelToken& cancel) const {
  const Result<Planned> planned = plan(scene, options, cancel);
  if (!planned) return planned.error();
  return picture(*planned, cancel);
}

RenderController::RenderController(MakeDraw makeDraw, QObject* parent)
    : QObject(parent), makeDraw_(std::move(makeDraw)), thread_([this] { run(); }) {}

RenderController::~RenderController() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    volumeCancel_.cancel();
    restCancel_.cancel();
    pictureCancel_.cancel();
    trialCancel_.cancel();
  }
  wake_.notify_one();
  thread_.join();
}

void RenderController::setVolume(VolumePtr volume) {
  {
    const std::lock_guard lock(mutex_);
    volume_ = std::move(volume);
    ++generation_;
    screen_.reset();
    trial_.reset();
    thumbnails_.reset();
    volumeCancel_.cancel();
    restCancel_.cancel();
    trialCancel_.cancel();
    volumeCancel_ = CancelToken();
  }
  wake_.notify_one();
}

void RenderController::request(const Scene& scene, QSize pixels) {
  if (pixels.isEmpty()) return;
  {
    const std::lock_guard lock(mutex_);
    screen_ = ScreenRequest{scene, pixels, resampler_, level_};
    restCancel_.cancel();
    trialCancel_.cancel();
  }
  wake_.notify_one();
}

void RenderController::setResampler(Resampler resampler) {
  const std::lock_guard lock(mutex_);
  resampler_ = resampler;
}

void RenderController::setLevel(PictureLevel level) {
  const std::lock_guard lock(mutex_);
  level_ = level;
}

int RenderController::requestTrial(const Scene& scene, QSize pixels, PictureLevel level) {
  {
    const std::lock_guard lock(mutex_);
    trialCancel_.cancel();
    trial_ = ScreenRequest{scene, pixels, resampler_, level};
    ++trialNumber_;
  }
  wake_.notify_one();
  return trialNumber_;
}

void RenderController::dropTrial() {
  const std::lock_guard lock(mutex_);
  trial_.reset();
  trialCancel_.cancel();
}

int RenderController::requestPicture(const VolumePtr& volume, const Scene& scene,
                                     const RenderOptions& options) {
  int number = 0;
  {
    const std::lock_guard lock(mutex_);
    trialCancel_.cancel();
    number = ++pictureNumber_;
    pictures_.push_back({number, volume, scene, options, CancelToken()});
  }
  wake_.notify_one();
  return number;
}

int RenderController::requestThumbnails(std::vector<Scene> scenes, QSize pixels) {
  {
    const std::lock_guard lock(mutex_);
    thumbnails_ = Thumbnails{std::move(scenes), pixels};
    ++thumbnailBatch_;
  }
  wake_.notify_one();
  return thumbnailBatch_;
}

void RenderController::cancelPictures() {
  const std::lock_guard lock(mutex_);
  pictureCancel_.cancel();
  for (const PictureRequest& request : pictures_) request.cancel.cancel();
}

double RenderController::pictureDone() const {
  const std::lock_guard lock(mutex_);
  return pictureCancel_.done();
}

// Runs a function on the thread of this object, unless the volume has changed by then.
template <class Function>
void RenderController::tell(Function function) {
  QMetaObject::invokeMethod(
      this,
      [this, generation = drawnGeneration_, function] {
        if (generation == generation_) function();
      },
      Qt::QueuedConnection);
}

bool RenderController::waitForWork(std::unique_lock<std::mutex>& lock) {
  const auto something = [this] {
    return closing_ || generation_ != drawnGeneration_ || screen_ || !pictures_.empty() || trial_ ||
           thumbnails_;
  };
  if (!something()) {
    tell([this] { Q_EMIT workingChanged(false); });
    wake_.wait(lock, something);
    tell([this] { Q_EMIT workingChanged(true); });
  }
  return !closing_;
}

void RenderController::run() {
  std::unique_lock lock(mutex_);
  while (waitForWork(lock)) {
    if (generation_ != drawnGeneration_) {
      drawnGeneration_ = generation_;
      drawnVolume_ = volume_;
      pace_ = DraftPace();
      cost_ = RestCost();
      seen_.reset();
      lock.unlock();
      draw_ = drawnVolume_ ? std::optional(makeDraw_(drawnVolume_)) : std::nullopt;
      lock.lock();
    } else if (screen_) {
      drawScreen(lock);
    } else if (!pictures_.empty()) {
      drawPicture(lock);
    } else if (trial_) {
      drawTrial(lock);
    } else {
      drawThumbnail(lock);
    }
  }
  draw_.reset();  // on this thread, which its OpenGL context belongs to
}

Result<Drawn> RenderController::draw(const Scene& scene, const RenderOptions& options,
                                     const CancelToken& cancel) {
  if (!draw_) return Error{"Nothing is open to be drawn."};
  return (*draw_)(scene, options, cancel);
}

void RenderController::drawPicture(std::unique_lock<std::mutex>& lock) {
  const PictureRequest request = std::move(pictures_.front());
  pictures_.pop_front();
  pictureCancel_ = request.cancel;
  lock.unlock();
  const bool shown = request.volume == drawnVolume_ && draw_;
  const Draw picture = shown ? *draw_ : makeDraw_(request.volume);
  Result<Drawn> drawn = picture(request.scene, request.options, request.cancel);
  const auto saved = drawn ? std::make_shared<Drawn>(std::move(*drawn)) : nullptr;
  const QString failure = saved                        ? QString()
                          : request.cancel.cancelled() ? tr("Cancelled.")
                                                       : QString::fromStdString(drawn.message());
  // Also where another volume is shown by now.
  QMetaObject::invokeMethod(
      this, [this, number = request.number, saved, failure] { Q_EMIT pictureReady(number, saved, failure); },
      Qt::QueuedConnection);
  lock.lock();
  pictureCancel_ = CancelToken();
}

// A draft, but never finer than the picture at rest.
RenderController::Pass RenderController::firstPass(PictureLevel rest) const {
  const double factor = pace_.factor();
  if (rest.quality == Quality::draft && rest.edge >= factor) return {Quality::draft, double(rest.edge)};
  return {factor > 1 ? Quality::draft : Quality::standard, factor};
}

void RenderController::drawScreen(std::unique_lock<std::mutex>& lock) {
  const ScreenRequest request = *std::exchange(screen_, std::nullopt);
  const CancelToken volumeCancel = volumeCancel_;
  if (!draw_) return;
  lock.unlock();
  const Pass first = firstPass(request.level);
  const Pass rest{request.level.quality, double(request.level.edge)};
  // Another level of what is on screen needs no draft.
  const bool seen = seen_ && seen_->scene == request.scene && seen_->pixels == request.pixels;
  const bool drawn = (seen && first != rest) || drawFrame(request, first, first == rest, volumeCancel);
  if (drawn) seen_ = request;
  lock.lock();
  const auto other = [this] { return closing_ || screen_ || generation_ != drawnGeneration_; };
  if (!drawn || first == rest || other()) return;
  // What is on screen of the same scene may be finer than any draft.
  if (!seen && !drawBetween(request, first, lock)) return;
  restCancel_ = CancelToken();
  const CancelToken cancel = restCancel_;
  lock.unlock();
  const Clock::time_point begin = Clock::now();
  const View view = viewOf(request, rest);
  const Ahead ahead{draw_->plan(view.scene, view.options, cancel), begin + restTime};
  lock.lock();
  if (wake_.wait_until(lock, ahead.rest, other)) return;
  lock.unlock();
  drawFrame(request, rest, true, cancel, &ahead);
  lock.lock();
}

// A draft between the first one and the picture at rest, where that will take long; false where something
// else is asked for meanwhile.
bool RenderController::drawBetween(const ScreenRequest& request, Pass first,
                                   std::unique_lock<std::mutex>& lock) {
  const auto factor = cost_.factorBetween(first.factor, request.level.edge);
  if (!factor) return true;
  const auto other = [this] { return closing_ || screen_ || generation_ != drawnGeneration_; };
  if (wake_.wait_for(lock, restTime, other)) return false;
  restCancel_ = CancelToken();
  const CancelToken cancel = restCancel_;
  lock.unlock();
  const bool drawn = drawFrame(request, {Quality::draft, *factor}, false, cancel);
  lock.lock();
  return drawn && !other();
}

// Stays asked for where something else interrupts it.
void RenderController::drawTrial(std::unique_lock<std::mutex>& lock) {
  const ScreenRequest request = *trial_;
  if (!draw_) return trial_.reset();
  trialCancel_ = CancelToken();
  const CancelToken cancel = trialCancel_;
  lock.unlock();
  ScreenPicture frame;
  Result<Drawn> drawn = drawPass(request, {request.level.quality, double(request.level.edge)}, frame, cancel);
  lock.lock();
  if (cancel.cancelled()) return;
  trial_.reset();
  Trial trial{trialNumber_, request.level, request.pixels, frame.ms - frame.stats.gradientsMs, nullptr, {}};
  if (drawn)
    trial.drawn = std::make_shared<const Drawn>(std::move(*drawn));
  else
    trial.failure = QString::fromStdString(drawn.message());
  tell([this, trial] { Q_EMIT trialReady(trial); });
}

// One at a time, so that anything else comes in between; drawn again where something interrupts it.
void RenderController::drawThumbnail(std::unique_lock<std::mutex>& lock) {
  if (!draw_ || thumbnails_->next == thumbnails_->scenes.size()) return thumbnails_.reset();
  const Scene scene = thumbnails_->scenes[thumbnails_->next];
  const int batch = thumbnailBatch_, n = int(thumbnails_->next);
  RenderOptions options;
  options.size = {thumbnails_->pixels.width(), thumbnails_->pixels.height()};
  options.quality = Quality::draft;
  trialCancel_ = CancelToken();
  const CancelToken cancel = trialCancel_;
  lock.unlock();
  const Result<Drawn> drawn = draw(scene, options, cancel);
  const QImage image = drawn ? toImage(drawn->picture) : QImage();
  lock.lock();
  if (cancel.cancelled() || batch != thumbnailBatch_) return;
  ++thumbnails_->next;
  // What cannot be drawn has no thumbnail.
  if (drawn) tell([this, batch, n, image] { Q_EMIT thumbnailReady(batch, n, image); });
}

RenderController::View RenderController::viewOf(const ScreenRequest& request, Pass pass) const {
  View view{request.scene, {}, {}};
  if (!view.shown.camera)
    view.shown.camera = fitCamera(firstCamera(drawnVolume_->geometry()), drawnVolume_->geometry(),
                                  double(request.pixels.width()) / request.pixels.height());
  const DraftView draft = draftView(*view.shown.camera, request.pixels, pass.factor);
  view.scene = view.shown;
  view.scene.camera = draft.camera;
  view.options.size = {draft.size.width(), draft.size.height()};
  view.options.quality = pass.quality;
  if (pass.quality != Quality::draft && request.resampler == Resampler::gl)
    view.options.resampler = Resampler::gl;
  return view;
}

Result<Drawn> RenderController::drawPass(const ScreenRequest& request, Pass pass, ScreenPicture& frame,
                                         const CancelToken& cancel, const Ahead* ahead) {
  const Clock::time_point begin = ahead ? ahead->rest : Clock::now();
  View view = viewOf(request, pass);
  frame.quality = pass.quality;
  frame.factor = pass.factor;
  frame.scene = std::move(view.shown);
  Result<Drawn> drawn = !ahead            ? draw(view.scene, view.options, cancel)
                        : !ahead->planned ? Result<Drawn>(ahead->planned.error())
                                          : draw_->picture(*ahead->planned, cancel);
  if (!drawn) return drawn;
  frame.image =
      pass.factor == 1 ? toImage(drawn->picture) : enlarged(drawn->picture, pass.factor, request.pixels);
  frame.plan = std::make_shared<const Plan>(drawn->plan);
  frame.stats = drawn->stats;
  frame.estimated = pass.factor == 1 ? estimateOf(drawn->error) : std::nullopt;
  if (frame.estimated) frame.error = std::make_shared<const std::vector<float>>(drawn->error);
  frame.ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  return drawn;
}

bool RenderController::drawFrame(const ScreenRequest& request, Pass pass, bool atRest,
                                 const CancelToken& cancel, const Ahead* ahead) {
  ScreenPicture frame;
  frame.atRest = atRest;
  Result<Drawn> drawn = drawPass(request, pass, frame, cancel, ahead);
  if (!drawn && !cancel.cancelled()) {
    tell([this, sentence = QString::fromStdString(drawn.message())] { Q_EMIT failed(sentence); });
    if (request.resampler == Resampler::gl && pass.quality != Quality::draft) {
      setResampler(Resampler::cpu);
      ScreenRequest again = request;
      again.resampler = Resampler::cpu;
      drawn = drawPass(again, pass, frame, cancel);
    }
  }
  if (!drawn) return false;
  // What is made once for the volume says nothing about the next frame, and a full picture at rest nothing
  // about drafts.
  const double ms = std::max(0.0, frame.ms - frame.stats.gradientsMs);
  if (pass == firstPass(request.level) && pass.factor == pace_.factor()) pace_.measured(ms);
  if (pass.quality == Quality::draft && !atRest) cost_.draftTook(ms, pass.factor);
  if (atRest) cost_.restTook(ms, request.level.edge);
  tell([this, frame] { Q_EMIT screenPictureReady(frame); });
  return true;
}

}  // namespace volumen
