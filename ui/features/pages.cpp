#include <QStackedWidget>
#include <algorithm>

#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/start_page.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Shows the views if any of them has content, else the start page.
class Pages : public Feature {
 public:
  explicit Pages(Workbench& bench);

 private:
  void choose();
  void showRecent();

  StartPage* start_;
};

Pages::Pages(Workbench& bench) : Feature(bench), start_(new StartPage) {
  bench_.pages.insertWidget(0, start_);
  bench_.pages.setCurrentWidget(start_);
  RecentFiles& recent = bench_.document.recent;
  connect(start_, &StartPage::openFolderRequested, bench_.shared.openFolder, &QAction::trigger);
  connect(start_, &StartPage::openFileRequested, bench_.shared.openFile, &QAction::trigger);
  connect(start_, &StartPage::sampleRequested, bench_.shared.openSample, &QAction::trigger);
  connect(start_, &StartPage::recentRequested, &bench_,
          [this](const QString& path) { Q_EMIT bench_.openRequested({path}); });
  connect(start_, &StartPage::clearRecentRequested, &recent, &RecentFiles::clear, Qt::QueuedConnection);
  connect(&recent, &RecentFiles::changed, this, &Pages::showRecent);
  showRecent();
  recent.look();
  whenChanged(session_, this, &Pages::choose, showsOther);
  connect(&bench_, &Workbench::otherShown, this, [this] {
    choose();
    if (bench_.pages.currentWidget() == &grid_ && !grid_.hasKeys()) grid_.takeKeys();
  });
}

void Pages::choose() {
  const Workspace& workspace = session_.workspace();
  const bool isAny = std::ranges::any_of(viewsOnScreen(workspace),
                                         [&](ViewId id) { return !workspace.view(id).series.empty(); });
  const bool appears = isAny && bench_.pages.currentWidget() != &grid_;
  bench_.pages.setCurrentWidget(isAny ? static_cast<QWidget*>(&grid_) : start_);
  // A page that appears would give the keyboard focus to its first child.
  if (appears) grid_.setFocus();
}

void Pages::showRecent() {
  const RecentFiles& recent = bench_.document.recent;
  QSet<QString> gone;
  for (const QString& path : recent.paths())
    if (recent.isGone(path)) gone.insert(path);
  start_->showRecent(recent.paths(), gone);
}

}  // namespace

std::unique_ptr<Feature> makePages(Workbench& bench) { return std::make_unique<Pages>(bench); }

}  // namespace volumen
