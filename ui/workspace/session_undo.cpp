#include "ui/workspace/edit_workspace.h"
#include "ui/workspace/session.h"

namespace volumen {

namespace {

// The stack returns its commands as constant; they are all its session's.
EditWorkspace& stepOf(const QUndoStack& stack, int n) {
  return const_cast<EditWorkspace&>(static_cast<const EditWorkspace&>(*stack.command(n)));
}

std::size_t labelBytesOf(const QUndoStack& stack) {
  std::size_t bytes = 0;
  for (int n = 0; n < stack.count(); ++n) bytes += stepOf(stack, n).labelBytes();
  return bytes;
}

}  // namespace

// Packs the labels of undo steps once they take more than a quarter of the budget, or the budget is spent.
// Drops the oldest steps if that is not enough. The last step stays as it is and counts apart: the next one
// may join it, and it holds what is shown.
void Session::fitUndo() {
  const std::size_t most = pool_->budget() / 4;
  if (const std::size_t bytes = labelBytesOf(undoStack_);
      bytes == 0 || (bytes <= most && pool_->counted() <= pool_->budget()))
    return;
  const int last = undoStack_.count() - 1;
  for (int n = 0; n < last; ++n) stepOf(undoStack_, n).pack(packer_);
  // Each brick counts for the last step that has it, so that the first steps count what goes with them.
  std::set<const void*> counted;
  for (int n = last; n >= 0; --n) stepOf(undoStack_, n).countLabels(counted);
  const std::size_t allowed = most + stepOf(undoStack_, last).labelBytes();
  std::size_t bytes = labelBytesOf(undoStack_);
  int dropped = 0;
  for (int n = 0; n < last && bytes > allowed; ++n) {
    EditWorkspace& step = stepOf(undoStack_, n);
    if (step.isDropped()) continue;
    bytes -= step.labelBytes();
    step.drop();
    ++dropped;
  }
  if (dropped > 0) Q_EMIT stepsDropped(dropped);
}

}  // namespace volumen
