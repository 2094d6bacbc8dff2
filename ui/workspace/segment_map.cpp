#include "ui/workspace/segment_map.h"

#include <QCryptographicHash>

namespace volumen {

bool SegmentMap::operator==(const SegmentMap& other) const {
  const bool same = labels == other.labels || (labels && other.labels && *labels == *other.labels);
  return same && series == other.series && segments == other.segments && missing == other.missing;
}

std::string checksumOf(const LabelMap& labels) {
  QCryptographicHash hash(QCryptographicHash::Blake2b_160);
  const auto add = [&](const auto& value) {
    hash.addData(QByteArrayView(reinterpret_cast<const char*>(&value), sizeof value));
  };
  add(labels.geometry().size);
  const glm::ivec3 count = labels.bricks();
  for (std::size_t n = 0; n < std::size_t(count.x) * count.y * count.z; ++n) {
    const LabelMap::Brick& brick = labels.brick(n);
    add(bool(brick.voxels));
    if (brick.voxels)
      add(*brick.voxels);
    else
      add(brick.label);
  }
  return hash.result().toHex().toStdString();
}

SavedLabels savedLabelsOf(const SegmentMap& map) {
  if (map.missing) return *map.missing;
  return map.labels ? SavedLabels{checksumOf(*map.labels), map.labels->geometry()} : SavedLabels{};
}

}  // namespace volumen
