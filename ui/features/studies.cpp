#include <QDockWidget>
#include <QMenu>
#include <QStackedWidget>

#include "results/text/text.h"
#include "ui/features/feature.h"
#include "ui/panels/attributes_dialog.h"
#include "ui/panels/flat_menus.h"
#include "ui/panels/studies_panel.h"
#include "ui/panels/study_model.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// The panel of open studies: shows, drags, overlays and closes series.
class Studies : public Feature {
 public:
  explicit Studies(Workbench& bench);

 private:
  void leaveKeys();
  void connectSession();
  void markShown();
  void addCommands(QMenu* more);
  void showDropped(const QMimeData& what);
  void closeAll(const Unlisted& listed);
  void showAttributes(const Series& series);
  void showAttributesInFocus();

  StudiesPanel* panel_;
  const QDockWidget* dock_;  // has the panel
};

Studies::Studies(Workbench& bench) : Feature(bench), panel_(new StudiesPanel(open_, bench.document.frames)) {
  dock_ = bench_.addDock({"studies", tr("Studies"), panel_, {Qt::LeftDockWidgetArea, 10}});
  const Loader* loader = &bench_.document.loader;
  connect(loader, &Loader::openBegan, this, &Studies::leaveKeys);
  connect(loader, &Loader::loadingChanged, this, [this, loader] {
    if (loader->isLoading()) leaveKeys();
  });
  bench_.shared.overlays = makeOverlayMenu(
      session_, [this] { return panel_->listedSeries(); }, &bench_.window);
  bench_.menus.addMenu(bench_.shared.overlays, {{"viewMenu", 60, 130}});
  connect(panel_, &StudiesPanel::seriesChosen, &bench_.document.opener, &Opener::show);
  connect(panel_, &StudiesPanel::objectChosen, &bench_, &Workbench::objectChosen);
  connect(panel_, &StudiesPanel::attributesRequested, this, &Studies::showAttributes);
  connect(panel_, &StudiesPanel::segmentsRequested, &bench_, &Workbench::segmentsRequested);
  // Files as they are have the patient's identity.
  const auto follow = [this] { panel_->setDragsFiles(!session_.preferences().exportsWithoutIdentity); };
  whenChanged(session_, panel_, follow, &Preferences::exportsWithoutIdentity);
  follow();
  connect(panel_, &StudiesPanel::sendRequested, &bench_, &Workbench::objectSendRequested);
  QAction* attributes = bench_.addAction({"attributes",
                                          tr("DICOM attributes..."),
                                          {},
                                          "",
                                          false,
                                          [this](bool) { showAttributesInFocus(); },
                                          {{"viewMenu", 60, 135}}});
  connect(&bench_, &Workbench::sliceMenuOpens, this,
          [attributes](QMenu* menu) { menu->addAction(attributes); });
  connect(&bench_, &Workbench::commandsOpen, this, &Studies::addCommands);
  connect(panel_, &StudiesPanel::removeRequested, &session_, &Session::close);
  connect(panel_, &StudiesPanel::closeAllRequested, this, &Studies::closeAll);
  connect(&grid_, &ViewGrid::dropped, this, &Studies::showDropped);
  connectSession();
}

// Moves the keyboard focus from the panel to the views, as keys are meant for the coming series.
void Studies::leaveKeys() {
  const QWidget* keys = bench_.window.focusWidget();
  if (!keys || !dock_->isAncestorOf(keys)) return;
  if (bench_.pages.currentWidget() == &grid_)
    grid_.takeKeys();
  else
    bench_.window.setFocus();
}

void Studies::connectSession() {
  connect(&bench_, &Workbench::otherShown, this, &Studies::markShown);
  connect(&open_, &OpenStudies::added, this, &Studies::markShown);  // after the panel has made its rows
  whenChanged(
      session_, this, [this] { open_.setUnlisted(*session_.workspace().unlisted); }, &Workspace::unlisted);
  whenChanged(
      session_, this,
      [this] {
        panel_->showNames();
        markShown();
      },
      &Preferences::hideNames);
}

void Studies::markShown() {
  const Series* series = seriesIn(session_.workspace(), session_.workspace().focus);
  if (!series) return;
  const LoadedSeriesPtr inMemory = session_.seriesOf(session_.workspace().focus);
  panel_->markShown(*series, inMemory ? inMemory->volume : nullptr);
}

// Adds commands that show open series, by name.
void Studies::addCommands(QMenu* more) {
  QMenu* menu = more->addMenu(tr("Show series"));
  for (const Series* series : open_.pictures()) {
    QString text = seriesText(*series);
    menu->addAction(text.replace(QLatin1Char('&'), QStringLiteral("&&")), this, [this, key = keyOf(*series)] {
      for (const Series* listed : open_.pictures())
        if (keyOf(*listed) == key) return bench_.document.opener.show(*listed);
    });
  }
}

void Studies::showDropped(const QMimeData& what) {
  if (const Series* series = panel_->seriesOf(what)) return bench_.document.opener.show(*series);
  const auto dragged = choiceIn(what);
  StudySource* source = dragged ? bench_.document.sources.offered(dragged->source) : nullptr;
  if (source) return source->open(dragged->choice, OpenHow::here);
  warn(tr("This series is not in a list of this window: open its folder (Ctrl+O)."));
}

void Studies::showAttributes(const Series& series) {
  (new AttributesDialog(session_, series, bench_.dialogParent()))->show();
}

void Studies::showAttributesInFocus() {
  const Series* series = seriesIn(session_.workspace(), session_.workspace().focus);
  if (!series) return warn(tr("Open a series first."));
  if (series->format != "DICOM" || series->files.empty())
    return warn(tr("Only pictures of DICOM files have attributes."));
  showAttributes(*series);
}

void Studies::closeAll(const Unlisted& listed) {
  bench_.banner.hide();
  session_.closeAll(listed);
  bench_.document.loader.cancel();
}

}  // namespace

std::unique_ptr<Feature> makeStudies(Workbench& bench) { return std::make_unique<Studies>(bench); }

}  // namespace volumen
