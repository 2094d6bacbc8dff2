#pragma once

#include <QUndoCommand>

#include "ui/workspace/session.h"

namespace volumen {

/// The one undo command: the workspace before and after. It is a small value, so no property needs a class of
/// its own.
class EditWorkspace : public QUndoCommand {
 public:
  /// `mergeKey`: commands of one non-empty key in one gesture merge.
  EditWorkspace(Session& session, const QString& text, Workspace after, const QString& mergeKey, int gesture);

  void undo() override;
  void redo() override;
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* later) override;

 private:
  Session& session_;
  Workspace before_, after_;
  QString mergeKey_;
  int gesture_;
};

}  // namespace volumen
