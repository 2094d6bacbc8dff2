#pragma once

#include <QImage>
#include <memory>
#include <vector>

#include "viewer/segment/segmentation.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// Segments over a flat picture.
struct SegmentLayer {
  struct Shown {
    std::size_t segment = 0;  ///< which of the segmentation's
    QRgb colour = 0;
    bool operator==(const Shown&) const = default;
  };
  std::shared_ptr<const Segmentation> segmentation;
  std::vector<Shown> shown;  ///< the later over the earlier
  double opacity = 1;
  bool operator==(const SegmentLayer&) const = default;
};

/// The picture of a plane with the segments mixed in at the pixels whose centre they hold.
QImage withSegments(QImage picture, const SlicePlane& plane, const SegmentLayer& layer);

}  // namespace volumen
