#pragma once

#include <QImage>
#include <memory>
#include <optional>

#include "results/series/loaded_frame.h"
#include "ui/controller/segment_layer.h"
#include "results/pictures/slice_image.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/view_id.h"

namespace volumen {

/// The content of a flat view.
struct SliceRequest {
  ViewId view = 0;
  std::vector<SliceLayer> layers;  ///< first at the bottom
  SlicePlane plane;
  LoadedFramePtr frame;    ///< drawn instead of the layers; null for none
  bool withLayers = true;  ///< overlays and shutters of a frame
  std::vector<SegmentLayer> segments{};
  bool ofLens = false;  ///< whether it is for the lens, a magnified part of the view
  bool operator==(const SliceRequest&) const = default;
};

/// A complete flat picture for the screen.
struct SlicePicture {
  SliceRequest request;
  QImage image;
};

/// Returns the complete picture of a request. The Error is that of sliceImage() or drawFrame().
Result<QImage> drawSlice(const SliceRequest& request);

/// Draws flat pictures on its own thread, so that they never wait for 3D pictures. Of each view and of its
/// lens only the latest request counts, in the order of the requests. No call waits.
class SliceService : public QObject {
  Q_OBJECT
 public:
  explicit SliceService(QObject* parent = nullptr);

  /// Requests a picture. With `isInFocus` it precedes other waiting requests, but not twice in a row.
  void request(SliceRequest latest, bool isInFocus = false);
  /// Cancels the requests of a view and its lens.
  void drop(ViewId view);

 Q_SIGNALS:
  void ready(const volumen::SlicePicture& picture);
  /// A sentence; not sent for replaced or dropped requests.
  void failed(int view, const QString& sentence);

 private:
  class Queue;

  std::shared_ptr<Queue> queue_;
  JobLane lane_;
};

}  // namespace volumen
