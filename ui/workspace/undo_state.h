#pragma once

#include <functional>
#include <set>

#include "ui/workspace/packed_labels.h"
#include "ui/workspace/workspace.h"

namespace volumen {

/// A workspace before or after an undo step. Its labels can be packed while it is not on screen.
class UndoState {
 public:
  explicit UndoState(Workspace workspace) : workspace_(std::move(workspace)) {}

  /// Returns the workspace, whose labels must not be packed.
  const Workspace& workspace() const { return workspace_; }
  void pack(LabelPacker& packer);
  void unpack();
  /// Forgets the workspace.
  void clear();
  /// Returns the bytes of labels that are not among the `counted` bricks yet, and adds them to these.
  std::size_t addLabelBytes(std::set<const void*>& counted) const;

 private:
  Workspace workspace_;
  std::vector<std::shared_ptr<PackedLabels>> packed_;  // by map of segments; null: it has no labels
  bool isPacked_ = false;
};

}  // namespace volumen
