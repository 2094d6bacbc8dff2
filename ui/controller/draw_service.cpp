#include "ui/controller/draw_service.h"

namespace volumen {

DrawService::DrawService(MakeDraw makeDraw, std::shared_ptr<SeriesPool> pool, QObject* parent)
    : QObject(parent), makeDraw_(std::move(makeDraw)), pool_(std::move(pool)), thread_([this] { run(); }) {}

DrawService::~DrawService() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    for (const auto& [id, view] : views_) {
      view.cancel.cancel();
      view.restCancel.cancel();
    }
    pictureCancel_.cancel();
    trialCancel_.cancel();
  }
  wake_.notify_one();
  thread_.join();
  for (auto& [id, view] : views_)
    if (view.awaited) answers_.push_back({id, std::exchange(view.awaited, 0), Answer::cancelled});
  tellAnswers();
}

void DrawService::show(ViewId id, VolumePtr volume) {
  {
    const std::lock_guard lock(mutex_);
    View& view = views_[id];
    if (view.volume == volume) return;
    view.volume = std::move(volume);
    view.shownAt = ++number_;
    view.pending.reset();
    view.restCancel.cancel();
    std::exchange(view.cancel, CancelToken()).cancel();
    if (view.awaited) answer(id, std::exchange(view.awaited, 0), Answer::cancelled);
  }
  wake_.notify_one();
}

int DrawService::request(ViewId id, const Scene& scene, QSize pixels) {
  const int number = ++number_;
  {
    const std::lock_guard lock(mutex_);
    View& view = views_[id];
    if (closing_ || !view.volume || pixels.isEmpty()) {
      answer(id, number, Answer::cancelled);
      return number;
    }
    if (view.awaited) answer(id, view.awaited, Answer::replaced);
    view.awaited = number;
    const bool waits = view.pending && view.pending->next == Work::draft;
    view.pending = {{number, scene, pixels, resampler_, view.level, errorWanted_},
                    Work::draft,
                    1,
                    waits ? view.pending->since : Clock::now()};
    for (const auto& [other, v] : views_) v.restCancel.cancel();
    trialCancel_.cancel();
  }
  wake_.notify_one();
  return number;
}

void DrawService::setGestureView(ViewId view) {
  const std::lock_guard lock(mutex_);
  gestureView_ = view;
}

void DrawService::setResampler(Resampler resampler) {
  const std::lock_guard lock(mutex_);
  resampler_ = resampler;
}

void DrawService::setErrorWanted(bool wanted) {
  const std::lock_guard lock(mutex_);
  errorWanted_ = wanted;
}

void DrawService::setLevel(ViewId view, PictureLevel level) {
  const std::lock_guard lock(mutex_);
  views_[view].level = level;
}

PictureLevel DrawService::level(ViewId view) const {
  const std::lock_guard lock(mutex_);
  const auto found = views_.find(view);
  return found == views_.end() ? PictureLevel() : found->second.level;
}

int DrawService::requestTrial(const VolumePtr& volume, const Scene& scene, QSize pixels, PictureLevel level) {
  {
    const std::lock_guard lock(mutex_);
    trialCancel_.cancel();
    trial_ = {volume, {++trialNumber_, scene, pixels, resampler_, level}};
  }
  wake_.notify_one();
  return trialNumber_;
}

void DrawService::dropTrial() {
  const std::lock_guard lock(mutex_);
  trial_.reset();
  trialCancel_.cancel();
}

int DrawService::requestPicture(const VolumePtr& volume, const Scene& scene, const RenderOptions& options) {
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

void DrawService::cancelPictures() {
  const std::lock_guard lock(mutex_);
  pictureCancel_.cancel();
  for (const PictureRequest& request : pictures_) request.cancel.cancel();
}

double DrawService::pictureDone() const {
  const std::lock_guard lock(mutex_);
  return pictureCancel_.done();
}

int DrawService::requestThumbnails(const VolumePtr& volume, std::vector<Scene> scenes, QSize pixels) {
  {
    const std::lock_guard lock(mutex_);
    thumbnails_.reset();
    if (!scenes.empty()) thumbnails_ = {volume, std::move(scenes), pixels};
    ++thumbnailBatch_;
  }
  wake_.notify_one();
  return thumbnailBatch_;
}

// Answers from the event loop, so that the caller has the number before its answer.
void DrawService::answer(ViewId view, int number, Answer answer) {
  answers_.push_back({view, number, answer});
  QMetaObject::invokeMethod(
      this, [this] { tellAnswers(); }, Qt::QueuedConnection);
}

void DrawService::tellAnswers() {
  while (!answers_.empty()) {
    const Answered next = answers_.front();
    answers_.pop_front();
    Q_EMIT answered(next.view, next.number, next.answer);
  }
}

void DrawService::deliver(const ScreenPicture& picture) {
  View& view = views_.at(picture.view);
  if (picture.number < view.shownAt) return;
  const bool last = picture.atRest && view.awaited == picture.number;
  if (last) view.awaited = 0;
  Q_EMIT screenPictureReady(picture);
  if (!last) return;
  answers_.push_back({picture.view, picture.number, Answer::drawn});
  tellAnswers();
}

void DrawService::deliverFailure(ViewId id, int number, const QString& sentence, bool last) {
  View& view = views_.at(id);
  if (number < view.shownAt) return;
  last = last && view.awaited == number;
  if (last) view.awaited = 0;
  Q_EMIT failed(id, sentence);
  if (!last) return;
  answers_.push_back({id, number, Answer::failed});
  tellAnswers();
}

}  // namespace volumen
