#include "ui/controller/slice_service.h"

#include <algorithm>

#include "ui/controller/frame_picture.h"

namespace volumen {

namespace {

Result<QImage> drawPicture(const SliceRequest& request) {
  if (!request.frame) return sliceImage(request.layers, request.plane);
  return drawFrame(*request.frame, request.plane, request.layers.front().grey, request.withLayers);
}

Result<QImage> draw(const SliceRequest& request) {
  Result<QImage> picture = drawPicture(request);
  if (!picture) return picture;
  for (const SegmentLayer& layer : request.segments)
    *picture = withSegments(std::move(*picture), request.plane, layer);
  return picture;
}

}  // namespace

SliceService::SliceService(QObject* parent) : QObject(parent), thread_([this] { run(); }) {}

SliceService::~SliceService() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void SliceService::request(SliceRequest request) {
  {
    const std::lock_guard lock(mutex_);
    const auto same = std::ranges::find(waiting_, request.view, &SliceRequest::view);
    if (same != waiting_.end())
      *same = std::move(request);
    else
      waiting_.push_back(std::move(request));
  }
  wake_.notify_one();
}

void SliceService::drop(ViewId view) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [&](const SliceRequest& r) { return r.view == view; });
}

void SliceService::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
    if (closing_) return;
    SliceRequest request = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    const Result<QImage> image = draw(request);
    if (image) {
      const SlicePicture picture{request, *image};
      QMetaObject::invokeMethod(
          this, [this, picture] { Q_EMIT ready(picture); }, Qt::QueuedConnection);
    } else {
      QMetaObject::invokeMethod(
          this,
          [this, view = request.view, sentence = QString::fromStdString(image.message())] {
            Q_EMIT failed(view, sentence);
          },
          Qt::QueuedConnection);
    }
    request = {};
    lock.lock();
  }
}

}  // namespace volumen
