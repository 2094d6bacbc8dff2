#include "ui/workspace/packed_labels.h"

#include <algorithm>

namespace volumen {

namespace {

constexpr int fastest = 1;  // level of compression

std::shared_ptr<const LabelMap::Voxels> voxelsOf(PackedBrick& brick) {
  if (auto held = brick.voxels.lock()) return held;
  const QByteArray bytes = qUncompress(brick.bytes);
  auto voxels = std::make_shared<LabelMap::Voxels>();
  std::copy_n(bytes.begin(), std::min(bytes.size(), qsizetype(voxels->size())), voxels->begin());
  brick.voxels = voxels;
  return voxels;
}

}  // namespace

std::shared_ptr<const LabelMap> PackedLabels::labels() {
  if (auto held = held_.lock()) return held;
  std::vector<LabelMap::Brick> bricks;
  bricks.reserve(bricks_.size());
  for (std::size_t n = 0; n < bricks_.size(); ++n)
    bricks.push_back({uniform_[n], bricks_[n] ? voxelsOf(*bricks_[n]) : nullptr});
  auto labels = std::make_shared<const LabelMap>(geometry_, std::move(bricks));
  held_ = labels;
  return labels;
}

std::shared_ptr<PackedLabels> LabelPacker::packed(const std::shared_ptr<const LabelMap>& labels) {
  std::weak_ptr<PackedLabels>& known = maps_[labels.get()];
  if (auto packed = known.lock(); packed && packed->held_.lock() == labels) return packed;
  const std::shared_ptr<PackedLabels> made(new PackedLabels(labels->geometry()));
  made->held_ = labels;
  const glm::ivec3 count = labels->bricks();
  for (std::size_t n = 0; n < std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z); ++n) {
    const LabelMap::Brick& brick = labels->brick(n);
    made->uniform_.push_back(brick.label);
    made->bricks_.push_back(brick.voxels ? packed(brick.voxels) : nullptr);
  }
  known = made;
  std::erase_if(maps_, [](const auto& map) { return map.second.expired(); });
  std::erase_if(bricks_, [](const auto& brick) { return brick.second.expired(); });
  return made;
}

std::shared_ptr<PackedBrick> LabelPacker::packed(const std::shared_ptr<const LabelMap::Voxels>& voxels) {
  std::weak_ptr<PackedBrick>& known = bricks_[voxels.get()];
  if (auto packed = known.lock(); packed && packed->voxels.lock() == voxels) return packed;
  const auto made = std::make_shared<PackedBrick>();
  made->voxels = voxels;
  made->bytes = qCompress(voxels->data(), qsizetype(voxels->size()), fastest);
  known = made;
  return made;
}

}  // namespace volumen
