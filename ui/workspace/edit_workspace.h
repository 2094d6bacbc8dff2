#pragma once

#include <QUndoCommand>

#include "ui/workspace/session.h"

namespace volumen {

/// Merge keys of the undo step that empties views for a series being loaded, and of the step that shows it.
/// The second is merged into the first, whatever its gesture.
inline const QString roomMadeKey = QStringLiteral("room made"), seriesShownKey = QStringLiteral("shown");

/// Merge keys of the undo step that hangs a study, and of the step that turns its pictures once they are
/// loaded.
inline const QString hungKey = QStringLiteral("hung"), facedKey = QStringLiteral("faced");

/// Merge key of Session::playOn(): the undo step before takes it in, whatever that is.
inline const QString playedOnKey = QStringLiteral("played on");

/// The only undo command: the workspace before and after. The two share equal parts, so no property needs a
/// command class of its own.
class EditWorkspace : public QUndoCommand {
 public:
  /// Commands with the same non-empty `mergeKey` merge within one gesture.
  EditWorkspace(Session& session, const QString& text, Workspace after, const QString& mergeKey, int gesture);
  ~EditWorkspace() override;

  void undo() override;
  void redo() override;
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* later) override;

 private:
  Session& session_;
  Workspace before_, after_;
  std::size_t labelBytes_;  // of labels that the step before has not; the pool counts them
  QString mergeKey_;
  int gesture_;
};

}  // namespace volumen
