#include <QDockWidget>
#include <QVBoxLayout>

#include "ui/features/feature.h"
#include "ui/panels/flat_panel.h"
#include "ui/panels/lights_panel.h"
#include "ui/panels/scene_panels.h"
#include "ui/panels/transfer_panel.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/explained.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

QWidget* stacked(QWidget* above, QWidget* below) {
  auto* both = new QWidget;
  auto* column = new QVBoxLayout(both);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(above);
  column->addWidget(below);
  column->addStretch();
  return both;
}

// Creates the panels of the scene and of slices and frames. Each reads the session and writes edits.
class Panels : public Feature {
 public:
  explicit Panels(Workbench& bench);

 private:
  QWidget* flatPanel();

  FlatPanel* flat_ = nullptr;
};

Panels::Panels(Workbench& bench) : Feature(bench) {
  const auto scrolling = [](QWidget* panel) { return Workbench::scrolling(panel); };
  const auto lights = [this] { return stacked(new LightsPanel(session_), makeMaterialPanel(session_)); };
  const CameraInView camera{[this] { return bench_.view()->camera(); },
                            [this](const QString& name) { bench_.view()->showView(name); },
                            [this] { bench_.view()->resetView(); }};
  using About = Workbench::About;
  const Qt::DockWidgetArea right = Qt::RightDockWidgetArea;
  auto* transfer = new TransferPanel(session_);
  connect(&bench_, &Workbench::rangeShown, transfer->editor(), &CurveEditor::setRange);
  connect(transfer->editor(), &CurveEditor::rangeDragged, &bench_, &Workbench::rangeDragged);
  connect(transfer, &TransferPanel::curvePulled, &bench_, &Workbench::curvePulled);
  constexpr int leastCurve = 183;  // lowest height for the mode and the curve
  const Workbench::DockEntry table[] = {
      {"transfer",
       tr("Opacity and colour"),
       Workbench::scrolling(transfer, leastCurve),
       {right, 0, true, About::scene}},
      {"lights", tr("Lights"), scrolling(lights()), {right, 10, true, About::scene}},
      {"camera",
       tr("Camera"),
       scrolling(makeCameraPanel(session_, camera)),
       {right, 80, false, About::scene}},
  };
  for (const Workbench::DockEntry& entry : table) bench_.addDock(entry);
  const QDockWidget* flat =
      bench_.addDock({"flat", tr("Slices and frames"), flatPanel(), {right, 5, true, About::flat}});
  const QDockWidget* clip =
      bench_.addDock({"clip", tr("Clip"), bench_.ofScene(scrolling(makeClipPanel(session_))), {right, 20}});
  connect(clip, &QDockWidget::visibilityChanged, &grid_, &ViewGrid::setClipShown);
  connect(flat, &QDockWidget::visibilityChanged, flat_, &FlatPanel::setWatched);
}

QWidget* Panels::flatPanel() {
  const auto seen = [this]() -> std::optional<FlatShown> {
    const FlatView* view = bench_.flatViewInFocus();
    if (!view) return {};
    FlatShown shown{view->id(), view->shown(), view->windowShown(), {}, -1};
    for (const FlatView::WindowChoice& choice : view->windows()) {
      if (choice.isChosen && shown.chosen < 0) shown.chosen = int(shown.windows.size());
      shown.windows << choice.name;
    }
    return shown;
  };
  const auto choose = [this](int n) {
    if (FlatView* view = bench_.flatViewInFocus()) view->chooseWindow(n);
  };
  const auto invert = [this] {
    if (FlatView* view = bench_.flatViewInFocus()) view->invert();
  };
  flat_ = new FlatPanel(session_, {seen, choose, invert}, bench_.shared.overlays);
  auto* explained = new Explained(Workbench::scrolling(flat_));
  const auto follow = [this, explained] {
    FlatView* view = bench_.flatViewInFocus();
    explained->explain(view ? QString() : tr("Click a slice or a frame to set how it is shown."));
    // Refreshes when the frame has been read.
    if (view) connect(view, &FlatView::settled, flat_, &FlatPanel::refresh, Qt::UniqueConnection);
  };
  whenChanged(session_, explained, follow, showsOther);
  connect(&grid_, &ViewGrid::aloneChanged, explained, follow);
  follow();
  return explained;
}

}  // namespace

std::unique_ptr<Feature> makePanels(Workbench& bench) { return std::make_unique<Panels>(bench); }

}  // namespace volumen
