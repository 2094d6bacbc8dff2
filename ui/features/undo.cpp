#include <QUndoStack>

#include "ui/features/action_text.h"
#include "ui/features/feature.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/plain_text.h"

namespace volumen {

namespace {

// Undo and redo, named after their step.
class Undo : public Feature {
 public:
  explicit Undo(Workbench& bench);

 private:
  void add(const char* name, QAction* action, QKeySequence::StandardKey key);
};

Undo::Undo(Workbench& bench) : Feature(bench) {
  QUndoStack& stack = session_.undoStack();
  add("undo", stack.createUndoAction(&bench_.window, tr("Undo")), QKeySequence::Undo);
  add("redo", stack.createRedoAction(&bench_.window, tr("Redo")), QKeySequence::Redo);
  connect(&session_, &Session::stepsDropped, this, [this](int steps) {
    bench_.banner.add(
        tr("Undo forgot its oldest steps (%1): the segments in them take more memory than there "
           "is. Allow more in the preferences under Memory for series.")
            .arg(steps));
  });
  connect(&session_, &Session::droppedStepMet, this, [this] {
    bench_.banner.add(
        tr("This step cannot be undone or done again: undo forgot it for lack of memory. Nothing "
           "was changed."));
  });
}

void Undo::add(const char* name, QAction* action, QKeySequence::StandardKey key) {
  action->setObjectName(QLatin1String(name));
  action->setShortcuts(key);
  action->setProperty("iconName", QLatin1String(name));
  // The tool tip, which defaults to the text, names the step.
  connect(action, &QAction::changed, action, [action] {
    if (action->toolTip() != toolTipOf(tipOf(*action))) action->setToolTip(toolTipOf(tipOf(*action)));
  });
  bench_.addAction(action, {{"editMenu", 10}, {"toolBar", 10, 20}});
}

}  // namespace

std::unique_ptr<Feature> makeUndo(Workbench& bench) { return std::make_unique<Undo>(bench); }

}  // namespace volumen
