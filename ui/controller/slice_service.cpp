#include "ui/controller/slice_service.h"

#include <mutex>
#include <utility>

#include "ui/controller/picture_underneath.h"

namespace volumen {

namespace {

// Over what lies underneath.
Result<QImage> withTintsAndSegments(Result<QImage> picture, const SliceRequest& request) {
  for (const SliceLayer& layer : request.layers)
    if (layer.tinted && picture) picture = withTint(std::move(*picture), layer, request.plane);
  if (!picture) return picture;
  for (const SegmentLayer& layer : request.segments)
    *picture = withSegments(std::move(*picture), request.plane, layer);
  return picture;
}

}  // namespace

Result<QImage> drawSlice(const SliceRequest& request) {
  return withTintsAndSegments(drawUnderneath(request), request);
}

struct SliceService::Waiting {
  std::mutex mutex;  // guards the request
  std::optional<SliceRequest> request;
  PictureUnderneath underneath;  // of the lane's thread

  Result<QImage> draw(const SliceRequest& latest) {
    return withTintsAndSegments(latest.frame ? drawUnderneath(latest) : underneath.of(latest), latest);
  }
};

void SliceService::request(SliceRequest latest) {
  std::shared_ptr<Waiting>& waiting = waiting_[{latest.view, latest.ofLens}];
  if (!waiting) waiting = std::make_shared<Waiting>();
  {
    const std::lock_guard lock(waiting->mutex);
    if (std::exchange(waiting->request, std::move(latest))) return;
  }
  lane_.run(
      {},
      [waiting](const Job&) {
        std::optional<SliceRequest> request;
        {
          const std::lock_guard lock(waiting->mutex);
          request = std::exchange(waiting->request, {});
        }
        Result<QImage> image = request ? waiting->draw(*request) : Result<QImage>(QImage());
        return std::pair(std::move(request), std::move(image));
      },
      [this](const std::pair<std::optional<SliceRequest>, Result<QImage>>& drawn) {
        const auto& [request, image] = drawn;
        if (!request) return;  // it was dropped
        if (image)
          Q_EMIT ready({*request, *image});
        else
          Q_EMIT failed(request->view, QString::fromStdString(image.message()));
      });
}

void SliceService::drop(ViewId view) {
  for (const bool ofLens : {false, true}) {
    const auto waiting = waiting_.find({view, ofLens});
    if (waiting == waiting_.end()) continue;
    const std::lock_guard lock(waiting->second->mutex);
    waiting->second->request.reset();
  }
}

}  // namespace volumen
