#include <algorithm>

#include "results/text/text.h"
#include "ui/features/action_text.h"
#include "ui/features/feature.h"
#include "ui/tools/tool.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Enables the tools that work in the view in focus. Names the tool chosen by a letter, as letters differ
// between flat views and 3D.
class ToolsInFocus : public Feature {
 public:
  explicit ToolsInFocus(Workbench& bench);

 private:
  void show();
};

// Says in which views a tool works.
QString whyNot(const Tool& tool, bool isOf3D) {
  if (!isOf3D) return tr("It works in slices: click a view of slices first.");
  return tool.inSlices ? tr("Click a view of slices or a 3D view first.")
                       : tr("It works in 3D: click a 3D view first.");
}

ToolsInFocus::ToolsInFocus(Workbench& bench) : Feature(bench) {
  connect(&bench_, &Workbench::made, this, [this] {
    for (const auto& [name, action] : bench_.actions)
      if (!keysOf(*action).isEmpty()) action->setToolTip(toolTipOf(tipOf(*action)));
    show();
  });
  whenChanged(session_, this, &ToolsInFocus::show, showsOther);
  connect(&grid_, &ViewGrid::toolChanged, this,
          [this] { tell(tr("Left button: %1").arg(grid_.tool().text)); });
}

void ToolsInFocus::show() {
  const Workspace& workspace = session_.workspace();
  const ViewKind kind = workspace.view(workspace.focus).kind;
  const bool isFlatView = isFlat(kind) || showsFrames(workspace, workspace.focus);
  const bool isScene = !isFlatView && showsScene(kind);
  const std::vector<const Tool*> of3D = chosenSceneTools();
  for (const auto& [tool, action] : bench_.toolActions) {
    const bool isOf3D = std::ranges::find(of3D, tool) != of3D.end() || (tool->draws() && tool->inScene);
    const bool isUsable = (isFlatView && tool->inSlices) || (isScene && isOf3D);
    action->setEnabled(isUsable);
    action->setToolTip(toolTipOf(QStringList{tipOf(*action), isUsable ? QString() : whyNot(*tool, isOf3D)}));
  }
}

}  // namespace

std::unique_ptr<Feature> makeToolsInFocus(Workbench& bench) { return std::make_unique<ToolsInFocus>(bench); }

}  // namespace volumen
