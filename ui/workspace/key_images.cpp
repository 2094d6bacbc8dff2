#include "ui/workspace/key_images.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumen {

namespace {

bool areOfOnePicture(const KeyImage& a, const KeyImage& b) {
  return a.series == b.series && a.sopInstanceUid == b.sopInstanceUid && a.frame == b.frame;
}

}  // namespace

PictureSeen pictureSeen(const Series& series, const VoxelGeometry& drawn, const SlicePlane& plane) {
  constexpr double parallel = 1e-3, onSlice = 1e-3;  // sine of an angle; fraction of a step
  const glm::dvec3 normal = sliceNormal(drawn);
  const double k = drawn.voxelFromPatient(plane.centre).z, nearest = std::round(k);
  if (!(plane.slabMm == 0 && glm::length(glm::cross(normal, plane.normal())) <= parallel &&
        std::abs(k - nearest) <= onSlice && nearest >= 0 && nearest < drawn.size.z))
    return {};
  if (!series.regular) return {int(nearest), false};
  const int copy = series.regular->copies[std::size_t(nearest)];
  return copy < 0 ? PictureSeen{{}, true} : PictureSeen{copy, false};
}

std::optional<int> drawnSlice(const Series& series, int index) {
  if (!series.regular) return index;
  const auto copy = std::ranges::find(series.regular->copies, index);
  if (copy == series.regular->copies.end()) return {};
  return int(copy - series.regular->copies.begin());
}

std::optional<KeyImage> keyImageOf(const Series& series, int index) {
  const auto n = std::size_t(index);
  if (index < 0 || n >= series.sopInstanceUids.size() || series.sopInstanceUids[n].empty()) return {};
  return KeyImage{keyOf(series), series.sopInstanceUids[n], series.frames[n], {}};
}

std::vector<int> keyImagesOf(const Workspace& workspace, const Series& series) {
  std::vector<int> marked;
  const SeriesKey key = keyOf(series);
  for (const KeyImage& image : workspace.keyImages) {
    if (image.series != key) continue;
    for (std::size_t n = 0; n < series.sopInstanceUids.size(); ++n)
      if (series.sopInstanceUids[n] == image.sopInstanceUid && series.frames[n] == image.frame)
        marked.push_back(int(n));
  }
  std::ranges::sort(marked);
  return marked;
}

bool isKeyImage(const Workspace& workspace, const KeyImage& image) {
  return std::ranges::any_of(workspace.keyImages,
                             [&](const KeyImage& k) { return areOfOnePicture(k, image); });
}

Workspace withKeyImageToggled(Workspace workspace, const KeyImage& image) {
  if (!workspace.keyImages.eraseIf([&](const KeyImage& k) { return areOfOnePicture(k, image); }))
    workspace.keyImages.push_back(image);
  return workspace;
}

}  // namespace volumen
