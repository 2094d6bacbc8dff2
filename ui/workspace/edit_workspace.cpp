#include "ui/workspace/edit_workspace.h"

namespace volumen {

EditWorkspace::EditWorkspace(Session& session, const QString& text, Workspace after, const QString& mergeKey,
                             int gesture)
    : QUndoCommand(text),
      session_(session),
      before_(session.workspace()),
      after_(std::move(after)),
      mergeKey_(mergeKey),
      gesture_(gesture) {}

void EditWorkspace::undo() { session_.setWorkspace(before_); }

void EditWorkspace::redo() { session_.setWorkspace(after_); }

bool EditWorkspace::mergeWith(const QUndoCommand* later) {
  const auto& next = static_cast<const EditWorkspace&>(*later);
  const bool fillsRoom = mergeKey_ == roomMadeKey && next.mergeKey_ == seriesShownKey;
  const bool faces = mergeKey_ == hungKey && next.mergeKey_ == facedKey;
  const bool continues = !mergeKey_.isEmpty() && next.mergeKey_ == mergeKey_ && next.gesture_ == gesture_;
  if (!fillsRoom && !faces && !continues && next.mergeKey_ != playedOnKey) return false;
  if (fillsRoom) {
    setText(next.text());
    mergeKey_.clear();
  }
  after_ = next.after_;
  setObsolete(before_ == after_);
  return true;
}

}  // namespace volumen
