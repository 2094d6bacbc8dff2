#include "ui/workspace/undo_state.h"

namespace volumen {

namespace {

using LabelsPtr = std::shared_ptr<const LabelMap>;

// Calls `change` for the labels of each map, of closed series too, always in the same order.
template <class Change>
void changeLabels(Workspace& workspace, const Change& change) {
  for (std::size_t n = 0; n < workspace.segmentMaps.size(); ++n)
    workspace.segmentMaps.edit(n).labels = change(workspace.segmentMaps[n].labels);
  for (std::size_t c = 0; c < workspace.closed.size(); ++c)
    for (std::size_t n = 0; n < workspace.closed[c].segmentMaps.size(); ++n)
      workspace.closed.edit(c).segmentMaps.edit(n).labels = change(workspace.closed[c].segmentMaps[n].labels);
}

template <class Visit>
void forEachLabels(const Workspace& workspace, const Visit& visit) {
  for (const SegmentMap& map : workspace.segmentMaps)
    if (map.labels) visit(*map.labels);
  for (const ClosedSeries& closed : workspace.closed)
    for (const SegmentMap& map : closed.segmentMaps)
      if (map.labels) visit(*map.labels);
}

}  // namespace

void UndoState::pack(LabelPacker& packer) {
  if (isPacked_) return;
  isPacked_ = true;
  const bool isKnown = !packed_.empty();
  changeLabels(workspace_, [&](const LabelsPtr& labels) {
    if (!isKnown) packed_.push_back(labels ? packer.packed(labels) : nullptr);
    return LabelsPtr();
  });
}

void UndoState::unpack() {
  if (!isPacked_) return;
  isPacked_ = false;
  auto next = packed_.begin();
  changeLabels(workspace_, [&](const LabelsPtr&) {
    const std::shared_ptr<PackedLabels>& packed = *next++;
    return packed ? packed->labels() : nullptr;
  });
}

void UndoState::clear() {
  workspace_ = {};
  packed_.clear();
  isPacked_ = false;
}

std::size_t UndoState::addLabelBytes(std::set<const void*>& counted) const {
  std::size_t bytes = 0;
  for (const auto& packed : packed_)
    for (const auto& brick : packed ? packed->bricks() : std::vector<std::shared_ptr<PackedBrick>>())
      if (brick && counted.insert(brick.get()).second) bytes += std::size_t(brick->bytes.size());
  forEachLabels(workspace_, [&](const LabelMap& labels) {
    if (!counted.insert(&labels).second) return;
    const glm::ivec3 count = labels.bricks();
    for (std::size_t n = 0; n < std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z); ++n)
      if (const auto& voxels = labels.brick(n).voxels; voxels && counted.insert(voxels.get()).second)
        bytes += sizeof(LabelMap::Voxels);
  });
  return bytes;
}

}  // namespace volumen
