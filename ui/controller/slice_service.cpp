#include "ui/controller/slice_service.h"

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

void SliceService::request(SliceRequest request) {
  drop(request.view);
  jobs_[request.view] = lane_.run(
      {}, [request](const Job&) { return draw(request); },
      [this, request](const Result<QImage>& image) {
        if (image)
          Q_EMIT ready({request, *image});
        else
          Q_EMIT failed(request.view, QString::fromStdString(image.message()));
      });
}

void SliceService::drop(ViewId view) { lane_.giveUpWaiting(jobs_[view]); }

}  // namespace volumen
