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

/// The picture of a plane with the segments mixed in at the pixels whose centre they hold: of a map those
/// whose nearest voxel has the label. Pixels beside one above, below, left or right that the segment does not
/// hold are its outline.
QImage withSegments(QImage picture, const SlicePlane& plane, const SegmentLayer& layer);

}  // namespace volumen
