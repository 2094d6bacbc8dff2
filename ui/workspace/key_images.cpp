#include "ui/workspace/key_images.h"

#include <algorithm>

namespace volumen {

std::optional<KeyImage> keyImageOf(const Series& series, int index) {
  const auto n = std::size_t(index);
  if (index < 0 || n >= series.sopInstanceUids.size() || series.sopInstanceUids[n].empty()) return {};
  return KeyImage{keyOf(series), series.sopInstanceUids[n], series.frames[n]};
}

bool isKeyImage(const Workspace& workspace, const KeyImage& image) {
  return std::ranges::find(workspace.keyImages, image) != workspace.keyImages.end();
}

Workspace withKeyImageToggled(Workspace workspace, const KeyImage& image) {
  if (std::erase(workspace.keyImages, image) == 0) workspace.keyImages.push_back(image);
  return workspace;
}

}  // namespace volumen
