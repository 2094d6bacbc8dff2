#pragma once

#include <QImage>
#include <memory>
#include <vector>

#include "viewer/segment/label_map.h"
#include "viewer/segment/segmentation.h"
#include "viewer/slice/plane.h"
#include "viewer/volume/rigid.h"

namespace volumen {

/// Segments over a flat picture: of a segmentation object, or of a label map.
struct SegmentLayer {
  struct Shown {
    std::size_t segment = 0;  ///< which of the segmentation's; of a map its label, 1 to 255
    QRgb colour = 0;
    double opacity = 1;  ///< times that of the layer
    bool operator==(const Shown&) const = default;
  };
  std::shared_ptr<const Segmentation> segmentation;  ///< null: the labels are shown
  std::vector<Shown> shown;                          ///< the later over the earlier
  double opacity = 1;                                ///< of their insides; outlines have twice as much
  std::shared_ptr<const LabelMap> labels{};          ///< null: the segmentation is
  Rigid fromPlane{};                                 ///< from the plane's patient space to that of the labels
  bool operator==(const SegmentLayer&) const = default;
};

/// The picture of a plane with the segments mixed in by how much of each pixel they cover (SegmentSamples):
/// of what a segment covers, the least that the pixel and the four beside it have is its inside, the rest its
/// outline. One too thin for more covers half a pixel at least; where all together cover more than a pixel,
/// each has less. Segments of an object are drawn one over the other. On all cores.
QImage withSegments(QImage picture, const SlicePlane& plane, const SegmentLayer& layer);

}  // namespace volumen
