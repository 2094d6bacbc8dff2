#pragma once

#include <QImage>
#include <memory>
#include <vector>

#include "ui/controller/slice_service.h"

namespace volumen {

/// What a request shows without tinted layers and segments, drawn anew. The Error is that of sliceImage() or
/// drawFrame().
Result<QImage> drawUnderneath(const SliceRequest& request);

/// The same of layers, drawn anew only where something else of the request differs from the last one: a
/// stroke of the brush changes segments alone, and what is dragged on the axis of the curve a tint. It keeps
/// no volume in memory.
class PictureUnderneath {
 public:
  Result<QImage> of(const SliceRequest& request);

 private:
  bool isOf(const std::vector<SliceLayer>& layers) const;

  SliceRequest request_;  // without tints, segments and volumes
  std::vector<std::weak_ptr<const Volume>> volumes_;
  QImage picture_;  // null: none was drawn
};

}  // namespace volumen
