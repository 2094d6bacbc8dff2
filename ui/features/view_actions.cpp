#include <QActionGroup>
#include <QMenu>
#include <QToolButton>
#include <QWidgetAction>

#include "ui/features/action_text.h"
#include "ui/features/feature.h"
#include "ui/tools/tool.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/grid_chooser.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/layout_text.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Returns the layout of the window in focus as the menu offers it.
Layout layoutInFocus(const Workspace& workspace) {
  const Layout layout = layoutOf(workspace, workspace.focus);
  const bool isOne = isInSecond(workspace.focus) && layout == SecondWindow().layout;
  return isOne ? Layout::one : layout;
}

// Actions for layouts, kinds of views, directions and 3D tools, and the context menu of 3D.
class ViewActions : public Feature {
 public:
  explicit ViewActions(Workbench& bench);

  void keep() override { bench_.document.opener.keepLayouts(); }

 private:
  void makeDirections();
  void makeLayouts();
  void makeGridChooser(QMenu* menu, QToolButton* button);
  void makePlaneTurns();
  void makeKinds();
  void makeTools();
  void showKinds();
  void addKinds(QMenu* menu) const;
  void addTool(QMenu* menu, const Tool& tool) const;
  void showVolumeMenu(QPoint global);
  void resetView();

  QActionGroup *kinds_, *tools_;
  QAction* resetView_;
};

ViewActions::ViewActions(Workbench& bench)
    : Feature(bench), kinds_(new QActionGroup(&bench_.window)), tools_(new QActionGroup(this)) {
  makeDirections();
  makeLayouts();
  makePlaneTurns();
  makeKinds();
  makeTools();
  connect(&grid_, &ViewGrid::menuRequested, this, [this](View* view, QPoint global) {
    if (qobject_cast<VolumeView*>(view)) showVolumeMenu(global);
  });
  connect(&bench_, &Workbench::sliceMenuOpens, this, [this](QMenu* menu) { addKinds(menu); });
  whenChanged(session_, this, &ViewActions::showKinds, showsOther);
}

void ViewActions::makeDirections() {
  const auto add = [this](const char* name, const QString& text, const QString& key, const char* icon,
                          const char* direction) {
    const auto show = [this, direction](bool) { bench_.view()->showView(QLatin1String(direction)); };
    bench_.addAction({name, text, {key}, icon, false, show, {{"sceneMenu", 20}}});
  };
  resetView_ = bench_.addAction({"resetView",
                                 tr("Reset view"),
                                 {tr("F")},
                                 "reset",
                                 false,
                                 [this](bool) { resetView(); },
                                 {{"viewMenu", 60, 62}, {"toolBar", 20, 10}}});
  add("viewAnterior", tr("Anterior view"), tr("A"), "view", "anterior");
  add("viewPosterior", tr("Posterior view"), tr("P"), "", "posterior");
  add("viewLeft", tr("Left view"), tr("L"), "", "left");
  add("viewRight", tr("Right view"), tr("R"), "", "right");
  add("viewSuperior", tr("Superior view"), tr("S"), "", "superior");
  add("viewInferior", tr("Inferior view"), tr("I"), "", "inferior");
}

void ViewActions::makeLayouts() {
  const std::tuple<Layout, const char*, QString, QString> table[] = {
      {Layout::one, "layoutOne", tr("One view"), tr("Alt+1")},
      {Layout::planes, "layoutPlanes", tr("Planes and 3D"), tr("Alt+2")},
      {Layout::besidePlanes, "layoutBesidePlanes", tr("Large 3D beside planes"), tr("Alt+3")},
      {Layout::two, "layoutTwo", tr("Two series"), tr("Alt+4")},
      {Layout::four, "layoutFour", tr("Four series"), tr("Alt+5")}};
  QMenu* menu = bench_.addMenu("layoutMenu", tr("Layout"), {{"viewMenu", 60, 50}});
  QToolButton* button = bench_.addMenuButton("layoutButton", 10);
  button->setText(tr("Layout"));
  button->setMenu(menu);
  auto* group = new QActionGroup(&bench_.window);
  for (const auto& [layout, name, text, key] : table) {
    QAction* action =
        group->addAction(bench_.addAction({name, text, {key}, "", true, {}, {{"layoutMenu", 10}}}));
    connect(action, &QAction::triggered, this,
            [this, layout = layout] { bench_.document.opener.chooseLayout(layout); });
    const auto show = [this, action, layout = layout] {
      const Workspace& workspace = session_.workspace();
      action->setChecked(layoutInFocus(workspace) == layout);
      // Layouts of planes are not available in the second window.
      action->setEnabled(!isInSecond(workspace.focus) || layout == Layout::one || comparesSeries(layout));
    };
    show();
    whenChanged(session_, action, show, layoutInFocus, &Workspace::focus);
  }
  makeGridChooser(menu, button);
}

// Adds a chooser for any grid of series to the menu.
void ViewActions::makeGridChooser(QMenu* menu, QToolButton* button) {
  auto* chooser = new GridChooser(Layout::mostRows, Layout::mostColumns, [](int rows, int columns) {
    return gridText({Layout::Kind::grid, rows, columns});
  });
  auto* field = new QWidgetAction(&bench_.window);
  field->setObjectName(QStringLiteral("layoutGrid"));
  field->setText(tr("Grid of series"));
  field->setShortcut(tr("Alt+6"));
  field->setDefaultWidget(chooser);
  bench_.window.addAction(field);
  bench_.addAction(field, {{"layoutMenu", 10, 10}});
  // Queued, because a menu closes after one of its own actions is triggered, even by a key.
  const auto openMenu = [this, menu, button, chooser] {
    const QWidget* window = grid_.viewShown()->window();
    menu->popup(window == &bench_.window ? button->mapToGlobal(button->rect().bottomLeft())
                                         : window->mapToGlobal(QPoint(0, 0)));
    chooser->setFocus(Qt::ShortcutFocusReason);
  };
  connect(field, &QAction::triggered, this, openMenu, Qt::QueuedConnection);
  connect(menu, &QMenu::aboutToShow, chooser, [this, chooser] {
    const Layout now = layoutOf(session_.workspace(), session_.workspace().focus);
    comparesSeries(now) ? chooser->light(now.rows, now.columns) : chooser->light(0, 0);
  });
  connect(chooser, &GridChooser::chosen, this, [this, menu](int rows, int columns) {
    menu->close();
    const bool isOne = rows == 1 && columns == 1;
    bench_.document.opener.chooseLayout(isOne ? Layout::one : Layout{Layout::Kind::grid, rows, columns});
  });
}

void ViewActions::makePlaneTurns() {
  using Turned = Crosshair (*)(glm::dvec3, const VoxelGeometry&);
  const Turned alongPatient = [](glm::dvec3 at, const VoxelGeometry&) {
    Crosshair straight{at};
    straight.byHand = true;
    return straight;
  };
  const std::tuple<const char*, QString, Turned> turns[] = {
      {"alignPlanes", tr("Planes along the slices"), alongSlices},
      {"straightenPlanes", tr("Planes along the patient"), alongPatient}};
  for (const auto& [name, text, turned] : turns) {
    const auto turn = [this, text = text, turned = turned](bool) {
      const ViewId focus = session_.workspace().focus;
      const LoadedSeriesPtr shown = session_.seriesOf(focus);
      if (!shown) return warn(tr("Open a series first."));
      const glm::dvec3 at = crosshairOf(session_.workspace(), focus, *shown).at;
      setCrosshair(session_, focus, *shown, text, turned(at, shown->volume->geometry()));
      session_.endGesture();
    };
    bench_.addAction({name, text, {}, "", false, turn, {{"layoutMenu", 20}}});
  }
}

void ViewActions::resetView() {
  if (auto* flat = grid_.viewAs<FlatView>(session_.workspace().focus))
    flat->resetView();
  else
    bench_.view()->resetView();
}

// Adds actions for what a comparison view shows.
void ViewActions::makeKinds() {
  bench_.addMenu("kindMenu", tr("Show in this view"), {{"viewMenu", 60, 60}});
  for (const KindRow& row : viewKinds()) {
    if (!row.action) continue;
    QAction* action =
        kinds_->addAction(bench_.addAction({row.action, tr(row.text), {}, "", true, {}, {{"kindMenu"}}}));
    action->setData(int(row.kind));
    connect(action, &QAction::triggered, this, [this, kind = row.kind] {
      session_.showAs(session_.workspace().focus, kind);
      showKinds();
    });
  }
  showKinds();
}

void ViewActions::showKinds() {
  const Workspace& workspace = session_.workspace();
  const ViewState& view = workspace.view(workspace.focus);
  const Series* series = seriesIn(workspace, workspace.focus);
  kinds_->setEnabled(canChangeKind(workspace.focus) && series && series->notVolume.empty());
  for (QAction* action : kinds_->actions()) action->setChecked(action->data().toInt() == int(view.kind));
}

void ViewActions::addKinds(QMenu* menu) const {
  if (kinds_->isEnabled()) menu->addActions(kinds_->actions());
}

// If the letter means a direction in 3D, shows the tool without its key.
void ViewActions::addTool(QMenu* menu, const Tool& tool) const {
  QAction* action = bench_.toolActions.at(&tool);
  if (bench_.view()->hasKey(tool)) return menu->addAction(action);
  QAction* keyless = menu->addAction(action->icon(), textOf(*action), action, &QAction::trigger);
  keyless->setObjectName(action->objectName() + QStringLiteral("InScene"));
  keyless->setCheckable(true);
  keyless->setChecked(action->isChecked());
  keyless->setEnabled(action->isEnabled());
}

void ViewActions::showVolumeMenu(QPoint global) {
  auto* menu = new QMenu(grid_.viewShown()->window());
  menu->setObjectName(QStringLiteral("volumeMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  addKinds(menu);
  menu->addSeparator();
  menu->addActions(tools_->actions());
  for (const Tool& tool : tools())
    if (tool.draws() && tool.inScene) addTool(menu, tool);
  menu->addSeparator();
  Q_EMIT bench_.sceneMenuOpens(menu);
  menu->addAction(resetView_);
  menu->popup(global);
}

void ViewActions::makeTools() {
  for (const Tool* tool : chosenSceneTools()) {
    const std::string name = std::string(tool->name) + "Tool";
    QAction* action = tools_->addAction(bench_.addAction({name.c_str(),
                                                          tool->text,
                                                          {QKeySequence(tool->key)},
                                                          tool->name,
                                                          true,
                                                          {},
                                                          {{"toolsMenu", 10}, {"toolBar", 20}}}));
    bench_.toolActions[tool] = action;
    action->setChecked(tool == &toolNamed("rotate"));
    connect(action, &QAction::triggered, this, [this, tool] { grid_.setSceneTool(*tool); });
  }
}

}  // namespace

std::unique_ptr<Feature> makeViewActions(Workbench& bench) { return std::make_unique<ViewActions>(bench); }

}  // namespace volumen
