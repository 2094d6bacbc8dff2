#include "ui/session/edit_scene.h"

#include "ui/session/session.h"

namespace volumen {

EditScene::EditScene(Session& session, const QString& text, Scene after, const QString& mergeKey, int gesture)
    : QUndoCommand(text),
      session_(session),
      before_(session.scene()),
      after_(std::move(after)),
      mergeKey_(mergeKey),
      gesture_(gesture) {}

void EditScene::undo() { session_.setScene(before_); }

void EditScene::redo() { session_.setScene(after_); }

bool EditScene::mergeWith(const QUndoCommand* later) {
  const auto& next = static_cast<const EditScene&>(*later);
  if (mergeKey_.isEmpty() || next.mergeKey_ != mergeKey_ || next.gesture_ != gesture_) return false;
  after_ = next.after_;
  setObsolete(before_ == after_);
  return true;
}

}  // namespace volumen
