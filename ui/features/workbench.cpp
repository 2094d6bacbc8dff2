#include "ui/features/workbench.h"

#include <QDockWidget>
#include <QEvent>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>

#include "ui/views/view_grid.h"
#include "ui/widgets/fold_title.h"

namespace volumen {

namespace {

class Scrolling : public QScrollArea {
 public:
  explicit Scrolling(QWidget* panel) {
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setWidget(panel);
  }

  QSize minimumSizeHint() const override {
    return {widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width(), 60};
  }

 protected:
  // A scroll area tells nobody that what it holds has grown.
  bool eventFilter(QObject* object, QEvent* event) override {
    if (object == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
    return QScrollArea::eventFilter(object, event);
  }
};

}  // namespace

Document::Document(const Services& services)
    : index(services.indexFolder, jobs), drawService(services.makeDraw), loader(jobs, services.makeScene) {}

Workbench::Workbench(const Services& theServices, Document& theDocument, const WindowParts& parts)
    : WindowParts(parts), services(theServices), document(theDocument) {}

void Workbench::addAboveViews(QWidget* widget) { column.insertWidget(column.count() - 1, widget); }

QAction* Workbench::addAction(const ActionEntry& entry) {
  auto* action = new QAction(entry.text, &window);
  action->setObjectName(QLatin1String(entry.name));
  action->setShortcuts(entry.shortcuts);
  action->setCheckable(entry.checkable);
  action->setProperty("iconName", QLatin1String(entry.icon));
  if (entry.run) connect(action, entry.checkable ? &QAction::toggled : &QAction::triggered, this, entry.run);
  window.addAction(action);
  return actions[action->objectName()] = action;
}

QAction* Workbench::actionOf(const Tool& tool) const {
  return actions.at(QLatin1String(tool.name) + QStringLiteral("Tool"));
}

void Workbench::addDock(const QString& name, const QString& title, QWidget* panel, Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title);
  dock->setObjectName(name + QStringLiteral("Dock"));
  panel->setObjectName(name + QStringLiteral("Panel"));
  dock->setWidget(panel);
  window.addDockWidget(area, dock);
  new FoldTitle(dock);
  connect(dock->toggleViewAction(), &QAction::triggered, dock, &QWidget::raise);
  docks[name] = dock;
}

QWidget* Workbench::scrolling(QWidget* panel) { return new Scrolling(panel); }

VolumeView* Workbench::view() const { return grid.volumeView(sceneViewOf(document.session.workspace())); }

Scene Workbench::sceneInView() const {
  Scene scene = document.session.scene();
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
  return grid.viewAs<FlatView>(asFrames ? framesViewOf(workspace.focus) : workspace.focus);
}

void Workbench::forEachVolumeView(const std::function<void(VolumeView*)>& call) {
  call(grid.volumeView(sceneViewId));
  connect(&grid, &ViewGrid::volumeViewMade, this, call);
}

}  // namespace volumen
