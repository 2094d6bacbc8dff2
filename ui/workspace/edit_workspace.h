#pragma once

#include <QUndoCommand>

#include "ui/workspace/session.h"

namespace volumen {

/// The merge key of a step that empties views for a series that is on its way, and that of a step that shows
/// a series: the second makes the first its own, in whatever gesture it comes.
inline const QString roomMadeKey = QStringLiteral("room made"), seriesShownKey = QStringLiteral("shown");

/// The same for a step that hangs a study, and that which turns its pictures once they are there.
inline const QString hungKey = QStringLiteral("hung"), facedKey = QStringLiteral("faced");

/// The merge key of what plays on: the step before takes it in, whatever that is.
inline const QString playedOnKey = QStringLiteral("played on");

/// The one undo command: the workspace before and after. They share what is the same in both, so no property
/// needs a class of its own.
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
