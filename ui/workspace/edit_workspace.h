#pragma once

#include <QUndoCommand>

#include "ui/workspace/session.h"
#include "ui/workspace/undo_state.h"

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

  /// Returns the bytes of labels that this step holds and its neighbours do not. The pool counts them.
  std::size_t labelBytes() const { return labelBytes_; }
  /// Counts them anew, without the bricks `counted` before, and adds its own to these.
  void countLabels(std::set<const void*>& counted);
  /// Packs the labels until the step is undone or done again.
  void pack(LabelPacker& packer);
  /// Forgets both workspaces. Undo then changes nothing, and says so.
  void drop();
  bool isDropped() const { return isDropped_; }

 private:
  void show(UndoState& state);
  void countLabels(std::size_t bytes);

  Session& session_;
  UndoState before_, after_;
  std::size_t labelBytes_ = 0;
  QString mergeKey_;
  int gesture_;
  bool isDropped_ = false;
};

}  // namespace volumen
