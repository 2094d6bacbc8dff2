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
        menu->addAction(actions_.at(name));
  };
  auto* file = menuBar()->addMenu(tr("&File"));
  fill(file,
       "openFolder openFile openSample | showBrowser findStudy importFolder | openSession saveSession "
       "saveSessionAs | openScene saveScene | "
       "snapshot copySnapshot | quit");
  recentMenu_ = new QMenu(tr("Open recent"), file);
  file->insertMenu(actions_.at(QStringLiteral("openSample")), recentMenu_);
  earlierMenu_ = new QMenu(tr("Restore earlier work"), file);
  earlierMenu_->setObjectName(QStringLiteral("earlierMenu"));
  file->insertMenu(actions_.at(QStringLiteral("openScene")), earlierMenu_);
  connect(file, &QMenu::aboutToShow, &recent_, &RecentFiles::look);
  fill(menuBar()->addMenu(tr("&Edit")), "undo redo | removeTable resetScissors | preferences");
  auto* view = menuBar()->addMenu(tr("&View"));
  view->addActions(sceneTools_->actions());
  fill(view,
       "resetView | viewAnterior viewPosterior viewLeft viewRight "
       "viewSuperior "
       "viewInferior | "
       "showAsFrames ownWindows overlaysAndShutters playFrames | "
       "keyImage previousKeyImage nextKeyImage | "
       "openGlResampler showError | maximise fullScreen lightTheme hideNames");
  layoutMenu_ = view->addMenu(tr("Layout"));
  auto* shown = view->addMenu(tr("Show in this view"));
  shown->addActions(kinds_->actions());
  fill(layoutMenu_,
       "layoutOne layoutPlanes layoutBesidePlanes layoutTwo layoutFour | alignPlanes straightenPlanes");
  linkMenu_ = makeLinkMenu(
      session_, [this] { registerViews(); }, view);
  view->addMenu(linkMenu_);
  view->addMenu(measureMenu_);
  view->addAction(actions_.at(QStringLiteral("interpolate")));
  view->addMenu(makeSlabMenu(session_, view));
  view->addMenu(makeColourMenu(session_, view));
  view->addMenu(makePetUnitMenu(session_, view));
  view->addMenu(makeOverlayMenu(
      session_, [this] { return studies_->listedSeries(); }, view));
  auto* docks = view->addMenu(tr("Panels"));
  for (const auto& [name, dock] : docks_) docks->addAction(dock->toggleViewAction());
  docks->addSeparator();
  docks->addAction(actions_.at(QStringLiteral("resetLayout")));
  fill(menuBar()->addMenu(tr("&Help")), "documentation shortcuts about");
}

void MainWindow::makeToolBar() {
  auto* bar = addToolBar(tr("Tools"));
  bar->setObjectName(QStringLiteral("tools"));
  bar->setMovable(false);
  bar->setIconSize({22, 22});
  const auto add = [&](const char* name) { bar->addAction(actions_.at(QLatin1String(name))); };
  for (const char* name : {"openFolder", "showBrowser", "undo", "redo"}) add(name);
  bar->addSeparator();
  bar->addActions(sceneTools_->actions());
  add("resetView");
  bar->addSeparator();
  makePresetBar(bar);
  auto* layouts = new QToolButton;
  layouts->setObjectName(QStringLiteral("layoutButton"));
  layouts->setText(tr("Layout"));
  layouts->setPopupMode(QToolButton::InstantPopup);
  layouts->setMenu(layoutMenu_);
  bar->addWidget(layouts);
  bar->addWidget(makeMeasureButton());
  auto* links = new QToolButton;
  links->setObjectName(QStringLiteral("linkButton"));
  links->setDefaultAction(linkMenu_->menuAction());
  links->setPopupMode(QToolButton::InstantPopup);
  bar->addWidget(links);
  auto* gap = new QWidget;
  gap->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  bar->addWidget(gap);
  add("snapshot");
  add("shortcuts");
}

void MainWindow::makePresetBar(QToolBar* bar) {
  presets_ = new PresetBar(session_, services_.presets);
  bar->addWidget(presets_);
  connect(presets_, &PresetBar::presetChosen, this,
          [this](const QString& name) { loader_.makePreset(name, session_.series()->volume); });
  connect(presets_, &PresetBar::failed, this, [this](const QString& sentence) { banner_->tell(sentence); });
  connect(presets_, &PresetBar::listChanged, this, [this] {
    thumbnailsOf_.reset();
    drawThumbnails();
  });
  QStringList problems;
  for (const std::string& problem : ownPresets().problems) problems << shownText(problem);
  if (!problems.isEmpty()) banner_->tell(tr("A preset of yours cannot be read."), problems);
  connect(&thumbnails_, &PresetThumbnails::ready, presets_, &PresetBar::showThumbnail);
}

}  // namespace volumen
