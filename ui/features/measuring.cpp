#include <QActionGroup>
#include <QMenu>
#include <QToolButton>
#include <algorithm>

#include "results/series/loaded_frame.h"
#include "ui/features/action_text.h"
#include "ui/features/feature.h"
#include "ui/features/theme.h"
#include "ui/panels/measurements_panel.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/measurements.h"
#include "viewer/measure/shape_cut.h"

namespace volumen {

namespace {

// Returns the flat view that shows a series, else the one in focus, else the first one, if any is on screen.
std::optional<ViewId> flatViewFor(const Workspace& workspace, const SeriesKey& series) {
  std::optional<ViewId> best;
  for (const ViewId id : viewsOnScreen(workspace)) {
    if (!showsSlices(workspace.view(id).kind)) continue;
    if (workspace.view(id).series == series) return id;
    if (!best || id == workspace.focus) best = id;
  }
  return best;
}

// Offers measuring tools in a menu, and the list of measurements.
class Measuring : public Feature {
 public:
  explicit Measuring(Workbench& bench);

 private:
  void makeActions();
  void showMeasurement(int id);
  void showOnFrame(const Measurement& m);
};

Measuring::Measuring(Workbench& bench) : Feature(bench) {
  makeActions();
  auto* panel = new MeasurementsPanel(session_, bench_.document.measurer);
  bench_.addDock(
      {"measurements", tr("Measure"), panel, {Qt::RightDockWidgetArea, 50, true, Workbench::About::flat}});
  bench_.forEachVolumeView([this](VolumeView* view) {
    connect(view, &VolumeView::missed, this, [this](const QString& sentence) { tell(sentence); });
  });
  connect(panel, &MeasurementsPanel::jumpRequested, this, &Measuring::showMeasurement);
  connect(panel, &MeasurementsPanel::saved, this,
          [this](const QString& path) { tell(tr("Saved %1").arg(path)); });
  connect(panel, &MeasurementsPanel::failed, this,
          [this](const QString& sentence) { warnUntilDone(sentence); });
}

// Most of these keys choose directions in 3D. Views handle them, and the menu only shows them.
void Measuring::makeActions() {
  QMenu* measures = bench_.addMenu("measureMenu", tr("Measure"), {});
  auto* group = new QActionGroup(&bench_.window);
  group->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);
  for (const Tool& tool : tools()) {
    if (!tool.measuring) continue;
    const QString name = QLatin1String(tool.name);
    const QString key = tool.key ? QLatin1Char('\t') + QKeySequence(tool.key).toString() : QString();
    auto* action = new QAction(tool.text + key, group);
    action->setObjectName(name + QStringLiteral("Tool"));
    action->setCheckable(true);
    action->setToolTip(toolTipOf(tipOf(*action)));
    action->setProperty("iconName", QStringLiteral("measure-") + name);
    connect(action, &QAction::triggered, this, [this, &tool](bool on) {
      if (!on) return grid_.restoreTool();
      grid_.setTool(tool);
    });
    connect(&grid_, &ViewGrid::toolChanged, action,
            [this, action, &tool] { action->setChecked(&grid_.tool() == &tool); });
    bench_.addAction(action, {{"measureMenu"}});
    bench_.toolActions[&tool] = action;
  }
  QAction* menu = measures->menuAction();
  for (const QAction* action : group->actions())
    connect(action, &QAction::enabledChanged, menu,
            [group, menu] { menu->setEnabled(std::ranges::any_of(group->actions(), &QAction::isEnabled)); });
  menu->setObjectName(QStringLiteral("measure"));
  const auto showTool = [this, menu] {
    const QString name = QStringLiteral("measure");
    const Tool& tool = grid_.tool();
    menu->setProperty("iconName", tool.measuring ? name + QLatin1Char('-') + QLatin1String(tool.name) : name);
    menu->setIcon(icon(menu->property("iconName").toString()));
  };
  connect(&grid_, &ViewGrid::toolChanged, menu, showTool);
  showTool();
  bench_.addAction(menu, {{"toolsMenu", 30}});
  QToolButton* button = bench_.addMenuButton("measureButton", 20);
  button->setDefaultAction(menu);
}

// Shows the frame in a view that has frames of its series, else in the view in focus.
void Measuring::showOnFrame(const Measurement& m) {
  const Workspace& now = session_.workspace();
  const auto series = now.series.at(m.series).series;
  const auto frame = frameMeant(*series, *m.shape.frame);
  if (!frame) return;
  const std::vector<ViewId> onScreen = viewsOnScreen(now);
  const auto shows = [&](ViewId id) {
    return now.view(id).series == m.series && showsFrames(now.view(id).kind);
  };
  const auto found = std::ranges::find_if(onScreen, shows);
  Workspace after = withFrames(now, found == onScreen.end() ? now.focus : *found, *series);
  const ViewId view = found == onScreen.end() ? framesViewOf(now.focus) : *found;
  after.editView(view).flats.editOrAdd(m.series).frame = *frame;
  after = withFocus(std::move(after), view);
  after.measurementsShown = true;
  after.selected = m.id;
  session_.change(tr("Go to measurement"), after);
}

// Shows the measurement in a flat view of its series, else in the view in focus.
void Measuring::showMeasurement(int id) {
  const Measurement* found = findMeasurement(session_.workspace(), id);
  if (!found || found->shape.points.empty()) return;
  const Measurement m = *found;
  if (m.shape.frame) return showOnFrame(m);
  const Series series = *session_.workspace().series.at(m.series).series;
  session_.endGesture();
  if (!flatViewFor(session_.workspace(), m.series))
    session_.change(tr("Layout"), withLayout(session_.workspace(), Layout::planes));
  const ViewId view = *flatViewFor(session_.workspace(), m.series);
  session_.setFocus(view);
  if (session_.workspace().view(view).series != m.series) bench_.document.opener.show(series);
  session_.change(tr("Go to measurement"), [&](Workspace& w) {
    const std::string frame = frameOfReference(series);
    auto& crosshairs = scrollsAlone(w, view) ? w.editView(view).crosshairs : w.crosshairs;
    crosshairs.editOrAdd(frame).at = middleOf(m.shape);
    w.measurementsShown = true;
    w.selected = m.id;
  });
}

}  // namespace

std::unique_ptr<Feature> makeMeasuring(Workbench& bench) { return std::make_unique<Measuring>(bench); }

}  // namespace volumen
