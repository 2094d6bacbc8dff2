#include "ui/features/feature.h"
#include "ui/tools/tool.h"
#include "ui/views/view_grid.h"

namespace volumen {

namespace {

// Returns letters that mean nothing in 3D and can be shortcuts. W has a meaning there, so views handle it.
QList<QKeySequence> keysOfTool(std::string_view name) {
  if (name == "pan") return {QObject::tr("M")};
  if (name == "zoom") return {QObject::tr("Z")};
  if (name == "scroll") return {QObject::tr("B")};
  if (name == "crosshair") return {QObject::tr("Y")};
  if (name == "magnifier") return {QObject::tr("V")};
  return {};
}

// One-shot tools have no button. All of these except one change segments.
std::vector<Place> placesOf(const Tool& tool) {
  if (!tool.draws()) return {{"toolsMenu", 15}, {"toolBar", 25}};
  if (tool.name == std::string_view("regionWindow")) return {{"toolsMenu", 15}, {"windowMenu", 20, 10}};
  return {{"segmentsMenu", 10}};
}

// Tools for the left button in slices and frames, except measuring tools.
class FlatTools : public Feature {
 public:
  explicit FlatTools(Workbench& bench);
};

FlatTools::FlatTools(Workbench& bench) : Feature(bench) {
  for (const Tool& tool : tools()) {
    if (!tool.inSlices || tool.measuring) continue;
    const std::string name = std::string(tool.name) + "Tool";
    const QString key = tool.key ? QLatin1Char('\t') + QKeySequence(tool.key).toString() : QString();
    QAction* action = bench_.addAction(
        {name.c_str(), tool.text + key, keysOfTool(tool.name), tool.name, true, {}, placesOf(tool)});
    bench_.toolActions[&tool] = action;
    const auto show = [this, action, &tool] { action->setChecked(&grid_.tool() == &tool); };
    connect(action, &QAction::triggered, this, [this, &tool, show] {
      grid_.setTool(tool);
      show();  // keeps the mark after a click on the chosen tool
    });
    connect(&grid_, &ViewGrid::toolChanged, action, show);
    show();
  }
}

}  // namespace

std::unique_ptr<Feature> makeFlatTools(Workbench& bench) { return std::make_unique<FlatTools>(bench); }

}  // namespace volumen
