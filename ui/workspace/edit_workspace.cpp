#include "ui/workspace/edit_workspace.h"

#include <algorithm>

namespace volumen {

namespace {

using LabelsPtr = std::shared_ptr<const LabelMap>;

bool hasLabels(const SharedList<SegmentMap>& maps, const LabelsPtr& labels) {
  return std::ranges::any_of(maps, [&](const SegmentMap& map) { return map.labels == labels; });
}

bool hasLabels(const Workspace& workspace, const LabelsPtr& labels) {
  return hasLabels(workspace.segmentMaps, labels) ||
         std::ranges::any_of(workspace.closed, [&](const ClosedSeries& closed) {
           return hasLabels(closed.segmentMaps, labels);
         });
}

// Bytes of the bricks that `last` does not share.
std::size_t bytesBeside(const LabelMap& labels, const LabelsPtr& last) {
  if (!last || last->bricks() != labels.bricks()) return labels.bytes();
  std::size_t bricks = 0;
  const glm::ivec3 count = labels.bricks();
  for (std::size_t n = 0; n < std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z); ++n)
    bricks += labels.brick(n).voxels && labels.brick(n).voxels != last->brick(n).voxels;
  return bricks * sizeof(LabelMap::Voxels);
}

std::size_t labelBytesBeside(const Workspace& before, const Workspace& after) {
  std::size_t bytes = 0;
  for (const SegmentMap& map : after.segmentMaps) {
    if (!map.labels || hasLabels(before, map.labels)) continue;
    const SegmentMap* last = segmentMapOf(before, map.series, map.number);
    bytes += bytesBeside(*map.labels, last ? last->labels : nullptr);
  }
  return bytes;
}

}  // namespace

EditWorkspace::EditWorkspace(Session& session, const QString& text, Workspace after, const QString& mergeKey,
                             int gesture)
    : QUndoCommand(text),
      session_(session),
      before_(session.workspace()),
      after_(std::move(after)),
      mergeKey_(mergeKey),
      gesture_(gesture) {
  countLabels(labelBytesBeside(before_.workspace(), after_.workspace()));
}

EditWorkspace::~EditWorkspace() { session_.pool().count(this, 0); }

void EditWorkspace::undo() { show(before_); }

void EditWorkspace::redo() { show(after_); }

void EditWorkspace::show(UndoState& state) {
  if (isDropped_) return Q_EMIT session_.droppedStepMet();
  state.unpack();
  session_.setWorkspace(state.workspace());
}

void EditWorkspace::countLabels(std::size_t bytes) {
  labelBytes_ = bytes;
  session_.pool().count(this, bytes);
}

void EditWorkspace::pack(LabelPacker& packer) {
  before_.pack(packer);
  after_.pack(packer);
}

void EditWorkspace::drop() {
  isDropped_ = true;
  before_.clear();
  after_.clear();
  countLabels(0);
}

void EditWorkspace::countLabels(std::set<const void*>& counted) {
  const std::size_t after = after_.addLabelBytes(counted);
  countLabels(after + before_.addLabelBytes(counted));
}

bool EditWorkspace::mergeWith(const QUndoCommand* later) {
  const auto& next = static_cast<const EditWorkspace&>(*later);
  const bool fillsRoom = mergeKey_ == roomMadeKey && next.mergeKey_ == seriesShownKey;
  const bool faces = mergeKey_ == hungKey && next.mergeKey_ == facedKey;
  const bool continues = !mergeKey_.isEmpty() && next.mergeKey_ == mergeKey_ && next.gesture_ == gesture_;
  if (isDropped_ || (!fillsRoom && !faces && !continues && next.mergeKey_ != playedOnKey)) return false;
  if (fillsRoom) {
    setText(next.text());
    mergeKey_.clear();
  }
  before_.unpack();
  after_ = next.after_;
  countLabels(labelBytes_ + next.labelBytes_);
  setObsolete(before_.workspace() == after_.workspace());
  return true;
}

}  // namespace volumen
