#pragma once

#include <QImage>
#include <memory>
#include <vector>

#include "viewer/segment/label_map.h"
#include "viewer/segment/segmentation.h"
#include "viewer/slice/plane.h"
#include "viewer/volume/rigid.h"

namespace volumen {

/// Segments over a flat picture, from a segmentation object or a label map.
struct SegmentLayer {
  struct Shown {
    std::size_t segment = 0;  ///< index in the segmentation, or label of the map, 1 to 255
    QRgb colour = 0;
    double opacity = 1;  ///< multiplied by that of the layer
    bool operator==(const Shown&) const = default;
  };
  std::shared_ptr<const Segmentation> segmentation;  ///< null if labels are shown
  std::vector<Shown> shown;                          ///< later segments cover earlier ones
  double opacity = 1;                                ///< of insides; outlines have twice as much
  std::shared_ptr<const LabelMap> labels{};          ///< null if the segmentation is shown
  Rigid fromPlane{};                                 ///< from the plane's patient space to that of the labels
  bool operator==(const SegmentLayer&) const = default;
};

/// Returns the picture of a plane with segments blended in by their coverage of each pixel (SegmentSamples).
/// The least coverage of a pixel and its four neighbours is inside; the rest is outline. Thin segments cover
/// at least half a pixel. If the total exceeds a pixel, each coverage is reduced. Segments of an object cover
/// each other in order. Uses all cores.
QImage withSegments(QImage picture, const SlicePlane& plane, const SegmentLayer& layer);

}  // namespace volumen
