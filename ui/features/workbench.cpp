#include "ui/features/workbench.h"

#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QMenu>
#include <QScrollArea>
#include <QScrollBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/explained.h"
#include "ui/widgets/fold_title.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

class Scrolling : public QScrollArea {
 public:
  Scrolling(QWidget* panel, int leastHeight) : leastHeight_(leastHeight) {
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setWidget(panel);
  }

  QSize minimumSizeHint() const override {
    return {widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width(), leastHeight_};
  }

 protected:
  // A scroll area does not report growth of its content.
  bool eventFilter(QObject* object, QEvent* event) override {
    if (object == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
    return QScrollArea::eventFilter(object, event);
  }

 private:
  int leastHeight_;
};

// Returns whether both have the same series open.
bool areSeriesOf(const Workspace& a, const Workspace& b) {
  return std::ranges::equal(
      a.series, b.series, {}, [](const auto& entry) { return entry.first; },
      [](const auto& entry) { return entry.first; });
}

}  // namespace

Document::Document(const Services& services)
    : sources(services.makeSources(services.indexFolder, jobs), services.indexFolder, jobs),
      drawService(services.makeDraw, session.sharedPool()),
      loader(session, jobs, services.makeScene) {
  frames.shareBudgetOf(session.sharedPool());
}

Workbench::Workbench(const Services& theServices, Document& theDocument, const WindowParts& parts)
    : WindowParts(parts), services(theServices), document(theDocument), menus(parts.window) {
  Session& session = document.session;
  connect(&session, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    const bool isSame = before.series && areOneSeries(before.series, after.series);
    if (before.series != after.series && !isSame) Q_EMIT otherShown();
  });
  const auto shown = [](const Workspace& w) {
    return std::pair(w.view(w.focus).series, showsFrames(w, w.focus));
  };
  whenChanged(session, this, &Workbench::otherShown, shown);
  whenChanged(
      session, this, [this] { banner.takeBackOfFocus(); }, &Workspace::focus, std::not_fn(areSeriesOf));
}

QWidget* Workbench::dialogParent() const {
  for (QWidget* used = QApplication::activeWindow(); used; used = used->parentWidget())
    if (used == &window || used == &grid.secondWindow()) return used;
  return grid.viewShown()->window();
}

void Workbench::addAboveViews(QWidget* widget) { column.insertWidget(column.count() - 1, widget); }

QAction* Workbench::addAction(const ActionEntry& entry) {
  auto* action = new QAction(entry.text, &window);
  action->setObjectName(QLatin1String(entry.name));
  action->setShortcuts(entry.shortcuts);
  action->setCheckable(entry.checkable);
  action->setProperty("iconName", QLatin1String(entry.icon));
  if (entry.run) connect(action, entry.checkable ? &QAction::toggled : &QAction::triggered, this, entry.run);
  window.addAction(action);
  addAction(action, entry.places);
  return action;
}

void Workbench::addAction(QAction* action, const std::vector<Place>& places) {
  actions[action->objectName()] = action;
  menus.add(action, places);
}

QMenu* Workbench::addMenu(const char* name, const QString& title, const std::vector<Place>& places) {
  auto* menu = new QMenu(title, &window);
  menu->setObjectName(QLatin1String(name));
  menus.addMenu(menu, places);
  return menu;
}

QToolButton* Workbench::addMenuButton(const char* name, int order) {
  auto* button = new QToolButton;
  button->setObjectName(QLatin1String(name));
  button->setPopupMode(QToolButton::InstantPopup);
  menus.addWidget(button, {"toolBar", 30, order});
  return button;
}

QDockWidget* Workbench::addDock(const DockEntry& entry) {
  const QString name = QLatin1String(entry.name);
  auto* dock = new QDockWidget(entry.title);
  dock->setObjectName(name + QStringLiteral("Dock"));
  entry.panel->setObjectName(name + QStringLiteral("Panel"));
  dock->setWidget(entry.place.about == About::scene ? ofScene(entry.panel) : entry.panel);
  window.addDockWidget(entry.place.area, dock);
  new FoldTitle(dock);
  connect(dock->toggleViewAction(), &QAction::triggered, dock, &QWidget::raise);
  docks[name] = {dock, entry.place};
  return dock;
}

QWidget* Workbench::scrolling(QWidget* panel, int leastHeight) { return new Scrolling(panel, leastHeight); }

QWidget* Workbench::ofScene(QWidget* panel) {
  auto* explained = new Explained(panel);
  const auto show = [this, explained] { explained->explain(whyNoScene()); };
  connect(&document.session, &Session::changed, explained, show);
  whenChanged(document.session, explained, show, showsOther);
  show();
  return explained;
}

// Hides the scene unless it belongs to the view in focus, so that no other patient's data stay on screen.
QString Workbench::whyNoScene() const {
  const Workspace& workspace = document.session.workspace();
  const std::vector<ViewId> onScreen = viewsOnScreen(workspace);
  const auto isEmpty = [&](ViewId id) { return workspace.view(id).series.empty(); };
  if (std::ranges::all_of(onScreen, isEmpty)) return tr("Open a series first.");
  if (!sceneIsOfFocus(workspace)) {
    const auto isScene = [&](ViewId id) { return showsScene(workspace.view(id).kind) && !isEmpty(id); };
    return std::ranges::any_of(onScreen, isScene)
               ? tr("Click a 3D view to set how it is drawn.")
               : tr("There is no 3D view of what is in focus: View > Show in this view > 3D makes one.");
  }
  return showsFrames(workspace, workspace.focus) && !document.session.series()
             ? tr("Frames are shown as acquired, not in 3D.")
             : QString();
}

VolumeView* Workbench::view() const { return grid.volumeView(sceneViewOf(document.session.workspace())); }

Scene Workbench::sceneInView() const {
  Scene scene = document.drawn.scene(sceneViewOf(document.session.workspace()));
  scene.camera = view()->camera();
  return scene;
}

FrameView* Workbench::framesInFocus() const {
  const Workspace& workspace = document.session.workspace();
  return showsFrames(workspace, workspace.focus) ? grid.viewAs<FrameView>(framesViewOf(workspace.focus))
                                                 : nullptr;
}

FlatView* Workbench::flatViewInFocus() const {
  const Workspace& workspace = document.session.workspace();
  const bool asFrames = showsFrames(workspace, workspace.focus);
  auto* view = grid.viewAs<FlatView>(asFrames ? framesViewOf(workspace.focus) : workspace.focus);
  return view && view->isVisibleTo(&grid) ? view : nullptr;
}

void Workbench::forEachVolumeView(const std::function<void(VolumeView*)>& call) {
  call(grid.volumeView(sceneViewId));
  connect(&grid, &ViewGrid::volumeViewMade, this, call);
}

}  // namespace volumen
