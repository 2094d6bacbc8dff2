#include "ui/main_window.h"

#include <QCloseEvent>
#include <QDockWidget>
#include <QSplitter>
#include <QStackedWidget>
#include <QStatusBar>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/status_line.h"
#include "ui/workspace/hidden_paths.h"

namespace volumen {

MainWindow::MainWindow(const Services& services, QWidget* parent)
    : QMainWindow(parent), services_(services), document_(services_) {
  setObjectName(QStringLiteral("mainWindow"));
  setWindowTitle(QStringLiteral("volumen"));
  setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
  bench_ = std::make_unique<Workbench>(services_, document_, makeParts());
  for (const FeatureEntry& entry : features()) features_.push_back(entry.make(*bench_));
  connect(bench_.get(), &Workbench::drawnAtRest, this, &MainWindow::settled);
  bench_->menus.fill();
  Q_EMIT bench_->made();
}

MainWindow::~MainWindow() {
  // Panels, views and features refer to the document, so they are deleted before it.
  for (const auto& [name, dock] : bench_->docks) delete dock.widget;
  delete takeCentralWidget();
  features_.clear();
}

WindowParts MainWindow::makeParts() {
  auto* grid = new ViewGrid({document_.session, document_.drawn, document_.drawService, document_.slices,
                             document_.frames, document_.measurer, document_.derived, &document_.segments});
  auto* pages = new QStackedWidget;
  pages->addWidget(grid);
  auto* split = new QSplitter(Qt::Vertical);
  split->setObjectName(QStringLiteral("browserSplitter"));
  split->setChildrenCollapsible(false);
  split->addWidget(pages);
  auto* centre = new QWidget;
  auto* column = new QVBoxLayout(centre);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(split, 1);
  auto* banner = new Banner(split);
  banner->setWriting(withoutPaths);
  setCentralWidget(centre);
  auto* status = new StatusLine(document_.jobs);
  statusBar()->addWidget(status, 1);
  statusBar()->setSizeGripEnabled(false);
  return {*this, *grid, *banner, *status, *pages, *split, *column};
}

void MainWindow::open(const QStringList& paths, const std::optional<Scene>& scene) {
  Q_EMIT bench_->openRequested(paths, scene);
}

void MainWindow::end() {
  for (const auto& feature : features_) feature->closeUnasked();
  close();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  QStringList lost;
  for (const auto& feature : features_) lost << feature->unsavedText();
  lost.removeAll(QString());
  const auto mayClose = [&](const auto& feature) {
    return feature->mayClose(lost.join(QStringLiteral(", ")));
  };
  if (!std::ranges::all_of(features_, mayClose)) return event->ignore();
  for (const auto& feature : features_) feature->keep();
  event->accept();
}

}  // namespace volumen
