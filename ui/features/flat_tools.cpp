#include "ui/features/feature.h"
#include "ui/tools/tool.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

// Letters that mean nothing in 3D, so that shortcuts can have them: W, which does, views hear themselves.
QList<QKeySequence> keysOfTool(std::string_view name) {
  if (name == "pan") return {QObject::tr("M")};
  if (name == "zoom") return {QObject::tr("Z")};
  if (name == "scroll") return {QObject::tr("B")};
  if (name == "crosshair") return {QObject::tr("Y")};
  if (name == "magnifier") return {QObject::tr("V")};
  return {};
}

// What a left drag does in slices and frames, beside measuring: a button each; what is used once at a time
// stands in the menu alone.
class FlatTools : public Feature {
 public:
  explicit FlatTools(Workbench& bench);
};

FlatTools::FlatTools(Workbench& bench) : Feature(bench) {
  const std::vector<Place> inMenu{{"viewMenu", 15}}, inBoth{{"viewMenu", 15}, {"toolBar", 25}};
  for (const Tool& tool : tools()) {
    if (!tool.inSlices || tool.measuring) continue;
    const std::string name = std::string(tool.name) + "Tool";
    const QString key = tool.key ? QLatin1Char('\t') + QKeySequence(tool.key).toString() : QString();
    QAction* action = bench_.addAction({name.c_str(),
                                        tool.text + key,
                                        keysOfTool(tool.name),
                                        tool.name,
                                        true,
                                        {},
                                        tool.draws() ? inMenu : inBoth});
    const auto show = [this, action, &tool] { action->setChecked(&grid_.tool() == &tool); };
    connect(action, &QAction::triggered, this, [this, &tool, show] {
      grid_.setTool(tool);
      show();  // a click on the one that is chosen leaves it so
    });
    connect(&grid_, &ViewGrid::toolChanged, action, show);
    show();
  }
}

}  // namespace

std::unique_ptr<Feature> makeFlatTools(Workbench& bench) { return std::make_unique<FlatTools>(bench); }

}  // namespace volumen
