#include "ui/controller/render_controller.h"

#include <QElapsedTimer>
#include <algorithm>
#include <chrono>

namespace volumen {

namespace {

// How long nothing new must be asked for before the standard picture is begun.
constexpr std::chrono::milliseconds restTime{60};

}  // namespace

RenderController::RenderController(MakeDraw makeDraw, QObject* parent)
    : QObject(parent), makeDraw_(std::move(makeDraw)), thread_([this] { run(); }) {}

RenderController::~RenderController() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    volumeCancel_.cancel();
    standardCancel_.cancel();
    pictureCancel_.cancel();
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
    volumeCancel_.cancel();
    standardCancel_.cancel();
    volumeCancel_ = CancelToken();
  }
  wake_.notify_one();
}

void RenderController::request(const Scene& scene, QSize pixels) {
  if (pixels.isEmpty()) return;
  {
    const std::lock_guard lock(mutex_);
    screen_ = ScreenRequest{scene, pixels, resampler_};
    standardCancel_.cancel();
  }
  wake_.notify_one();
}

void RenderController::setResampler(Resampler resampler) {
  const std::lock_guard lock(mutex_);
  resampler_ = resampler;
}

void RenderController::requestPicture(const Scene& scene, const RenderOptions& options) {
  {
    const std::lock_guard lock(mutex_);
    pictureCancel_.cancel();
    pictureCancel_ = CancelToken();
    picture_ = PictureRequest{scene, options, pictureCancel_};
  }
  wake_.notify_one();
}

void RenderController::cancelPicture() {
  const std::lock_guard lock(mutex_);
  pictureCancel_.cancel();
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
    return closing_ || generation_ != drawnGeneration_ || screen_ || picture_;
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
      lock.unlock();
      draw_ = drawnVolume_ ? makeDraw_(drawnVolume_) : Draw();
      lock.lock();
    } else if (picture_) {
      drawPicture(lock);
    } else {
      drawScreen(lock);
    }
  }
  draw_ = Draw();  // on this thread, which its OpenGL context belongs to
}

Result<Drawn> RenderController::draw(const Scene& scene, const RenderOptions& options,
                                     const CancelToken& cancel) {
  if (!draw_) return Error{"Nothing is open to be drawn."};
  return draw_(scene, options, cancel);
}

void RenderController::drawPicture(std::unique_lock<std::mutex>& lock) {
  const PictureRequest request = *std::exchange(picture_, std::nullopt);
  lock.unlock();
  Result<Drawn> drawn = draw(request.scene, request.options, request.cancel);
  const auto picture = drawn ? std::make_shared<Drawn>(std::move(*drawn)) : nullptr;
  const QString failure = picture                      ? QString()
                          : request.cancel.cancelled() ? tr("Cancelled.")
                                                       : QString::fromStdString(drawn.message());
  tell([this, picture, failure] { Q_EMIT pictureReady(picture, failure); });
  lock.lock();
}

void RenderController::drawScreen(std::unique_lock<std::mutex>& lock) {
  const ScreenRequest request = *std::exchange(screen_, std::nullopt);
  const CancelToken volumeCancel = volumeCancel_;
  if (!draw_) return;
  lock.unlock();
  const double factor = pace_.factor();
  const bool drawn = drawFrame(request, factor, volumeCancel);
  lock.lock();
  const auto other = [this] { return closing_ || screen_ || generation_ != drawnGeneration_; };
  if (!drawn || factor == 1 || wake_.wait_for(lock, restTime, other)) return;
  standardCancel_ = CancelToken();
  const CancelToken cancel = standardCancel_;
  lock.unlock();
  drawFrame(request, 1, cancel);
  lock.lock();
}

bool RenderController::drawFrame(const ScreenRequest& request, double factor, const CancelToken& cancel) {
  QElapsedTimer clock;
  clock.start();
  Frame frame;
  frame.factor = factor;
  frame.scene = request.scene;
  if (!frame.scene.camera)
    frame.scene.camera = fitCamera(Camera{}, drawnVolume_->geometry(),
                                   double(request.pixels.width()) / request.pixels.height());
  const DraftView view = draftView(*frame.scene.camera, request.pixels, factor);
  Scene scene = frame.scene;
  scene.camera = view.camera;
  RenderOptions options;
  options.size = {view.size.width(), view.size.height()};
  options.quality = frame.draft() ? Quality::draft : Quality::standard;
  if (!frame.draft()) options.resampler = request.resampler;
  Result<Drawn> drawn = draw(scene, options, cancel);
  if (!drawn && !cancel.cancelled()) {
    tell([this, sentence = QString::fromStdString(drawn.message())] { Q_EMIT failed(sentence); });
    if (options.resampler == Resampler::gl) {
      options.resampler = Resampler::cpu;
      setResampler(Resampler::cpu);
      drawn = draw(scene, options, cancel);
    }
  }
  if (!drawn) return false;
  frame.image = factor == 1 ? toImage(drawn->picture) : enlarged(drawn->picture, factor, request.pixels);
  frame.plan = std::make_shared<const Plan>(std::move(drawn->plan));
  frame.stats = drawn->stats;
  frame.ms = double(clock.nsecsElapsed()) / 1e6;
  // What is made once for the volume says nothing about the next frame, and a full picture at rest nothing
  // about drafts.
  if (factor == pace_.factor()) pace_.measured(std::max(0.0, frame.ms - drawn->stats.gradientsMs));
  tell([this, frame] { Q_EMIT frameReady(frame); });
  return true;
}

}  // namespace volumen
