#pragma once

#include <QImage>
#include <memory>
#include <vector>

#include "ui/controller/slice_service.h"

namespace volumen {

/// Draws a request without tinted layers and segments. The Error is that of sliceImage() or drawFrame().
Result<QImage> drawUnderneath(const SliceRequest& request);

/// Caches drawUnderneath() for layers and redraws only if the rest of the request changes. A brush stroke
/// changes only segments, and a drag on the axis of the curve only a tint. It keeps no volume in memory.
class PictureUnderneath {
 public:
  Result<QImage> of(const SliceRequest& request);

 private:
  bool isOf(const std::vector<SliceLayer>& layers) const;

  SliceRequest request_;  // without tints, segments and volumes
  std::vector<std::weak_ptr<const Volume>> volumes_;
  QImage picture_;  // null before the first picture
};

}  // namespace volumen
