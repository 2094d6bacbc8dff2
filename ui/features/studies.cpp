#include "ui/features/feature.h"
#include "ui/panels/flat_menus.h"
#include "ui/panels/studies_panel.h"
#include "ui/panels/study_model.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"

namespace volumen {

namespace {

// The list of what is open: chosen there or dragged from there into a view, laid over what a view shows, and
// taken off the list.
class Studies : public Feature {
 public:
  explicit Studies(Workbench& bench);

 private:
  void connectSession();
  void markShown();
  void showDropped(const QMimeData& what);
  void closeAll(const Unlisted& listed);

  StudiesPanel* panel_;
};

Studies::Studies(Workbench& bench) : Feature(bench), panel_(new StudiesPanel(open_)) {
  bench_.addDock({"studies", tr("Studies"), panel_, {Qt::LeftDockWidgetArea, 10}});
  bench_.menus.addMenu(makeOverlayMenu(
                           session_, [this] { return panel_->listedSeries(); }, &bench_.window),
                       {{"viewMenu", 60, 130}});
  connect(panel_, &StudiesPanel::seriesChosen, &bench_.document.opener, &Opener::show);
  connect(panel_, &StudiesPanel::objectChosen, &bench_, &Workbench::objectChosen);
  connect(panel_, &StudiesPanel::removeRequested, &session_, &Session::close);
  connect(panel_, &StudiesPanel::closeAllRequested, this, &Studies::closeAll);
  connect(&grid_, &ViewGrid::dropped, this, &Studies::showDropped);
  connectSession();
}

void Studies::connectSession() {
  connect(&bench_, &Workbench::otherShown, this, &Studies::markShown);
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (before.unlisted != after.unlisted) open_.setUnlisted(*after.unlisted);
          });
  connect(&session_, &Session::preferencesChanged, this,
          [this](const Preferences& before, const Preferences& after) {
            if (before.hideNames == after.hideNames) return;
            panel_->showNames();
            markShown();
          });
}

void Studies::markShown() {
  const Series* series = seriesIn(session_.workspace(), session_.workspace().focus);
  if (!series) return;
  const LoadedSeriesPtr inMemory = session_.seriesOf(session_.workspace().focus);
  panel_->markShown(*series, inMemory ? inMemory->volume : nullptr);
}

void Studies::showDropped(const QMimeData& what) {
  if (const Series* series = panel_->seriesOf(what)) bench_.document.opener.show(*series);
  if (const auto choice = choiceIn(what)) bench_.document.sources.current().open(*choice, OpenHow::here);
}

void Studies::closeAll(const Unlisted& listed) {
  bench_.document.loader.cancel();
  bench_.banner.hide();
  session_.closeAll(listed);
}

}  // namespace

std::unique_ptr<Feature> makeStudies(Workbench& bench) { return std::make_unique<Studies>(bench); }

}  // namespace volumen
