#include <QActionGroup>
#include <QDockWidget>
#include <QMenuBar>
#include <QToolBar>
#include <QToolButton>

#include "ui/main_window.h"
#include "ui/panels/flat_menus.h"
#include "ui/panels/link_menu.h"
#include "ui/panels/pet_unit_menu.h"
#include "ui/panels/preset_bar.h"
#include "ui/panels/slab_menu.h"
#include "ui/panels/studies_panel.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/text.h"

namespace volumen {

void MainWindow::makeMenus() {
  const auto fill = [this](QMenu* menu, const char* names) {
    for (const QString& name : QString::fromLatin1(names).split(QLatin1Char(' ')))
      if (name == QStringLiteral("|"))
        menu->addSeparator();
      else
        menu->addAction(bench_->actions.at(name));
  };
  auto* file = menuBar()->addMenu(tr("&File"));
  fill(file,
       "openFolder openFile openSample | showBrowser findStudy importFolder | openSession saveSession "
       "saveSessionAs | openScene saveScene | "
       "snapshot copySnapshot | quit");
  recentMenu_ = new QMenu(tr("Open recent"), file);
  file->insertMenu(bench_->action("openSample"), recentMenu_);
  file->insertAction(bench_->action("openScene"), bench_->action("earlierMenu"));
  connect(file, &QMenu::aboutToShow, &recent_, &RecentFiles::look);
  fill(menuBar()->addMenu(tr("&Edit")), "undo redo | removeTable resetScissors | preferences");
  auto* view = menuBar()->addMenu(tr("&View"));
  for (const Tool* tool : chosenSceneTools()) view->addAction(bench_->actionOf(*tool));
  fill(view,
       "resetView | viewAnterior viewPosterior viewLeft viewRight "
       "viewSuperior "
       "viewInferior | "
       "showAsFrames ownWindows overlaysAndShutters playFrames | "
       "keyImage previousKeyImage nextKeyImage | "
       "openGlResampler showError | maximise fullScreen lightTheme hideNames");
  auto* layouts = view->addMenu(tr("Layout"));
  layouts->setObjectName(QStringLiteral("layoutMenu"));
  auto* shown = view->addMenu(tr("Show in this view"));
  fill(shown, "show3D showAxial showCoronal showSagittal");
  fill(layouts,
       "layoutOne layoutPlanes layoutBesidePlanes layoutTwo layoutFour | alignPlanes straightenPlanes");
  fill(view, "linkMenu measure interpolate");
  view->addMenu(makeSlabMenu(session_, view));
  view->addMenu(makeColourMenu(session_, view));
  view->addMenu(makePetUnitMenu(session_, view));
  view->addMenu(makeOverlayMenu(
      session_, [this] { return studies_->listedSeries(); }, view));
  auto* docks = view->addMenu(tr("Panels"));
  for (const auto& [name, dock] : bench_->docks) docks->addAction(dock->toggleViewAction());
  docks->addSeparator();
  docks->addAction(bench_->action("resetLayout"));
  fill(menuBar()->addMenu(tr("&Help")), "documentation shortcuts about");
}

void MainWindow::makeToolBar() {
  auto* bar = addToolBar(tr("Tools"));
  bar->setObjectName(QStringLiteral("tools"));
  bar->setMovable(false);
  bar->setIconSize({22, 22});
  const auto add = [&](const char* name) { bar->addAction(bench_->action(name)); };
  for (const char* name : {"openFolder", "showBrowser", "undo", "redo"}) add(name);
  bar->addSeparator();
  for (const Tool* tool : chosenSceneTools()) bar->addAction(bench_->actionOf(*tool));
  add("resetView");
  bar->addSeparator();
  for (QWidget* widget : bench_->toolBarWidgets) bar->addWidget(widget);
  auto* layouts = new QToolButton;
  layouts->setObjectName(QStringLiteral("layoutButton"));
  layouts->setText(tr("Layout"));
  layouts->setPopupMode(QToolButton::InstantPopup);
  layouts->setMenu(findChild<QMenu*>(QStringLiteral("layoutMenu")));
  bar->addWidget(layouts);
  auto* measures = new QToolButton;
  measures->setObjectName(QStringLiteral("measureButton"));
  measures->setDefaultAction(bench_->action("measure"));
  measures->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  measures->setPopupMode(QToolButton::InstantPopup);
  bar->addWidget(measures);
  auto* links = new QToolButton;
  links->setObjectName(QStringLiteral("linkButton"));
  links->setDefaultAction(bench_->action("linkMenu"));
  links->setPopupMode(QToolButton::InstantPopup);
  bar->addWidget(links);
  auto* gap = new QWidget;
  gap->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  bar->addWidget(gap);
  add("snapshot");
  add("shortcuts");
}

}  // namespace volumen
