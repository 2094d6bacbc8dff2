#pragma once

#include <QUndoCommand>

#include "viewer/scene/scene.h"

namespace volumen {

class Session;

/// The one undo command: the scene before and after. A scene is a small value, so no property needs a class
/// of its own.
class EditScene : public QUndoCommand {
 public:
  /// `mergeKey`: commands of one non-empty key in one gesture merge.
  EditScene(Session& session, const QString& text, Scene after, const QString& mergeKey, int gesture);

  void undo() override;
  void redo() override;
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* later) override;

 private:
  Session& session_;
  Scene before_, after_;
  QString mergeKey_;
  int gesture_;
};

}  // namespace volumen
