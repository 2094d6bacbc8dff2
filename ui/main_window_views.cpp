#include <QActionGroup>
#include <QSettings>
#include <QStackedWidget>
#include <algorithm>

#include "ui/main_window.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/status_line.h"

namespace volumen {

void MainWindow::makeLayoutActions() {
  const std::tuple<Layout, const char*, QString, QString> table[] = {
      {Layout::one, "layoutOne", tr("One view"), tr("Alt+1")},
      {Layout::planes, "layoutPlanes", tr("Planes and 3D"), tr("Alt+2")},
      {Layout::besidePlanes, "layoutBesidePlanes", tr("Large 3D beside planes"), tr("Alt+3")},
      {Layout::two, "layoutTwo", tr("Two series"), tr("Alt+4")},
      {Layout::four, "layoutFour", tr("Four series"), tr("Alt+5")}};
  auto* group = new QActionGroup(this);
  for (const auto& [layout, name, text, key] : table) {
    auto* action = group->addAction(text);
    action->setObjectName(QLatin1String(name));
    action->setShortcut(key);
    action->setCheckable(true);
    action->setChecked(layout == session_.workspace().layout);
    connect(action, &QAction::triggered, this, [this, layout = layout] {
      session_.change(tr("Layout"), withLayout(session_.workspace(), layout));
    });
    connect(&session_, &Session::workspaceChanged, action,
            [action, layout = layout](const Workspace&, const Workspace& after) {
              action->setChecked(after.layout == layout);
            });
    addAction(action);
    actions_[action->objectName()] = action;
  }
}

void MainWindow::connectViews() {
  connect(&session_, &Session::workspaceChanged, this, [this](const Workspace&, const Workspace& after) {
    const auto shows = [&](ViewId view) { return !after.view(view).series.empty(); };
    const bool any = std::ranges::any_of(viewsOnScreen(after), shows);
    pages_->setCurrentWidget(any ? static_cast<QWidget*>(grid_) : pages_->widget(0));
  });
  connect(grid_, &ViewGrid::hovered, status_, &StatusLine::showHover);
  connect(grid_, &ViewGrid::maximiseRequested, this,
          [this] { actions_[QStringLiteral("maximise")]->toggle(); });
  connect(&slices_, &SliceService::failed, this,
          [this](int, const QString& sentence) { banner_->tell(sentence); });
  // Whatever brings the 3D view on screen: it has to be drawn.
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (viewsOnScreen(before) == viewsOnScreen(after)) return;
            const ShownSeriesPtr& series = session_.series();
            drawService_.show(sceneViewId, series && !view_->isHidden() ? series->volume : nullptr);
            requestFrame();
          });
}

void MainWindow::resetViewInFocus() {
  if (SliceView* slice = grid_->sliceView(session_.workspace().focus))
    slice->resetView();
  else
    view_->resetView();
}

}  // namespace volumen
