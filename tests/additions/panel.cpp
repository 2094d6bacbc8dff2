// An addition: a panel that shows the number of steps that can be undone.
#include <QUndoStack>

#include "ui/widgets/plain_text.h"
#include "ui/workspace/session.h"

namespace volumen {

QWidget* makeNotesPanel(Session& session) {
  auto* label = plainLabel();
  QObject::connect(&session.undoStack(), &QUndoStack::indexChanged, label,
                   [label](int steps) { label->setText(QString::number(steps)); });
  return label;
}

}  // namespace volumen
