#include "ui/session/edit_state.h"

namespace volumen {

EditState::EditState(Session& session, const QString& text, SessionState after, const QString& mergeKey,
                     int gesture)
    : QUndoCommand(text),
      session_(session),
      before_(session.state()),
      after_(std::move(after)),
      mergeKey_(mergeKey),
      gesture_(gesture) {}

void EditState::undo() { session_.setState(before_); }

void EditState::redo() { session_.setState(after_); }

bool EditState::mergeWith(const QUndoCommand* later) {
  const auto& next = static_cast<const EditState&>(*later);
  if (mergeKey_.isEmpty() || next.mergeKey_ != mergeKey_ || next.gesture_ != gesture_) return false;
  after_ = next.after_;
  setObsolete(before_ == after_);
  return true;
}

}  // namespace volumen
