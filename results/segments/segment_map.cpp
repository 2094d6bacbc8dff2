#include "results/segments/segment_map.h"

#include <QCryptographicHash>
#include <map>
#include <mutex>

namespace volumen {

namespace {

// Keeps checksums of all maps in undo steps: autosave asks after every step.
class KnownChecksums {
 public:
  std::string of(const std::shared_ptr<const LabelMap>& labels) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto known = checksums_.find(labels); known != checksums_.end()) return known->second;
    }
    std::string checksum = checksumOf(*labels);
    const std::lock_guard lock(mutex_);
    std::erase_if(checksums_, [](const auto& known) { return known.first.expired(); });
    checksums_.emplace(labels, checksum);
    return checksum;
  }

 private:
  std::mutex mutex_;
  std::map<std::weak_ptr<const LabelMap>, std::string, std::owner_less<>> checksums_;
};

std::string knownChecksumOf(const std::shared_ptr<const LabelMap>& labels) {
  static KnownChecksums known;
  return known.of(labels);
}

}  // namespace

bool SegmentMap::operator==(const SegmentMap& other) const {
  const bool same = labels == other.labels || (labels && other.labels && *labels == *other.labels);
  return same && series == other.series && segments == other.segments && missing == other.missing &&
         current == other.current && in3d == other.in3d && steps == other.steps && tissue == other.tissue &&
         number == other.number;
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
  return map.labels ? SavedLabels{knownChecksumOf(map.labels), map.labels->geometry()} : SavedLabels{};
}

}  // namespace volumen
