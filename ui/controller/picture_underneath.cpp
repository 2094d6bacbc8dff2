#include "ui/controller/picture_underneath.h"

#include <algorithm>
#include <utility>

#include "ui/controller/frame_picture.h"

namespace volumen {

namespace {

std::vector<SliceLayer> untinted(std::vector<SliceLayer> layers) {
  std::erase_if(layers, [](const SliceLayer& layer) { return layer.tinted.has_value(); });
  return layers;
}

}  // namespace

Result<QImage> drawUnderneath(const SliceRequest& request) {
  if (!request.frame) return sliceImage(untinted(request.layers), request.plane);
  return drawFrame(*request.frame, request.plane, request.layers.front().grey, request.withLayers);
}

Result<QImage> PictureUnderneath::of(const SliceRequest& request) {
  SliceRequest bare = request;
  bare.segments.clear();
  const std::vector<SliceLayer> layers = untinted(request.layers);
  bare.layers = layers;
  std::vector<std::weak_ptr<const Volume>> volumes;
  for (SliceLayer& layer : bare.layers) volumes.push_back(std::exchange(layer.volume, nullptr));
  if (!picture_.isNull() && request_ == bare && isOf(layers)) return picture_;
  Result<QImage> drawn = drawUnderneath(request);
  if (!drawn) return drawn;
  request_ = std::move(bare), volumes_ = std::move(volumes);
  return picture_ = std::move(*drawn);
}

bool PictureUnderneath::isOf(const std::vector<SliceLayer>& layers) const {
  return std::ranges::equal(
      volumes_, layers, {}, [](const auto& volume) { return volume.lock(); }, &SliceLayer::volume);
}

}  // namespace volumen
