#include <QMenu>

#include "ui/features/feature.h"
#include "ui/views/flat_view.h"
#include "ui/workspace/view_window.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Gives the slice or frame in focus its own window, so that one series can be shown twice with two windows.
class WindowAlone : public Feature {
 public:
  explicit WindowAlone(Workbench& bench);

 private:
  void setAlone(bool alone);
  void follow();

  QAction* action_;
};

WindowAlone::WindowAlone(Workbench& bench)
    : Feature(bench),
      action_(bench.addAction({"windowAlone",
                               tr("Window of this view alone"),
                               {},
                               "",
                               true,
                               {},
                               {{"viewMenu", 60, 86}, {"windowMenu", 20}}})) {
  connect(action_, &QAction::triggered, this, &WindowAlone::setAlone);
  whenChanged(session_, this, &WindowAlone::follow, showsOther);
  connect(&bench_, &Workbench::sliceMenuOpens, this, [this](QMenu* menu) { menu->addAction(action_); });
  follow();
}

void WindowAlone::setAlone(bool alone) {
  const FlatView* view = bench_.flatViewInFocus();
  follow();  // restores the check mark after a click
  if (!view || !view->windowShown()) return warn(tr("Click a slice or a frame first."));
  session_.endGesture();
  session_.change(action_->text(), withWindowAlone(session_.workspace(), view->id(), alone));
  session_.endGesture();
}

void WindowAlone::follow() {
  const Workspace& workspace = session_.workspace();
  const ViewId id = showsFrames(workspace, workspace.focus) ? framesViewOf(workspace.focus) : workspace.focus;
  const ViewState& view = workspace.view(id);
  const bool isShown = isFlat(view.kind) && seriesIn(workspace, id);
  const FlatView* seen = bench_.flatViewInFocus();
  const bool isColour = seen && seen->shown() && !seen->windowShown();
  // Only a read frame tells whether it has colours.
  if (seen) connect(seen, &FlatView::settled, this, &WindowAlone::follow, Qt::UniqueConnection);
  action_->setEnabled(isShown && !isColour);
  action_->setChecked(isShown && flatLookOf(view).windowAlone);
}

}  // namespace

std::unique_ptr<Feature> makeWindowAlone(Workbench& bench) { return std::make_unique<WindowAlone>(bench); }

}  // namespace volumen
