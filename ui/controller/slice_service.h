#pragma once

#include <QImage>
#include <memory>
#include <optional>

#include "ui/controller/segment_layer.h"
#include "ui/controller/slice_image.h"
#include "ui/data/loaded_frame.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/view_id.h"

namespace volumen {

/// What a flat view shows.
struct SliceRequest {
  ViewId view = 0;
  std::vector<SliceLayer> layers;  ///< the first at the bottom
  SlicePlane plane;
  LoadedFramePtr frame;    ///< drawn in place of the layers; null: none
  bool withLayers = true;  ///< of a frame: overlays and shutters
  std::vector<SegmentLayer> segments{};
  bool ofLens = false;  ///< a part of the view, enlarged
  bool operator==(const SliceRequest&) const = default;
};

/// A flat picture for the screen, whole.
struct SlicePicture {
  SliceRequest request;
  QImage image;
};

/// The picture of a request, whole. The Error is that of sliceImage() or drawFrame().
Result<QImage> drawSlice(const SliceRequest& request);

/// Draws flat pictures on a thread of its own, so that they never wait for a 3D one: of each view, and of its
/// lens, the latest request, in the order in which they were asked for. Asking never waits.
class SliceService : public QObject {
  Q_OBJECT
 public:
  explicit SliceService(QObject* parent = nullptr);

  /// `isInFocus`: what the hand works in comes before others that wait, but not twice running before them.
  void request(SliceRequest latest, bool isInFocus = false);
  /// Gives up what is asked for of a view and of its lens.
  void drop(ViewId view);

 Q_SIGNALS:
  void ready(const volumen::SlicePicture& picture);
  /// A sentence; not for what was replaced or dropped.
  void failed(int view, const QString& sentence);

 private:
  class Queue;

  std::shared_ptr<Queue> queue_;
  JobLane lane_;
};

}  // namespace volumen
