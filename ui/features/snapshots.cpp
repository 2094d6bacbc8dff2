#include "ui/controller/snapshot.h"
#include "ui/features/feature.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

// Saves or copies pictures of the 3D view at any size and quality.
class Snapshots : public Feature {
 public:
  explicit Snapshots(Workbench& bench);

 private:
  void connectViews();
  void tellSize();
  std::optional<SnapshotSeen> seen();

  Snapshot snapshot_;
  SnapshotPanel* panel_;
};

Snapshots::Snapshots(Workbench& bench)
    : Feature(bench), snapshot_(bench.document.drawService, bench.document.jobs), panel_(new SnapshotPanel) {
  bench_.addDock({"snapshot",
                  tr("Snapshot"),
                  Workbench::scrolling(panel_),
                  {Qt::RightDockWidgetArea, 40, true, Workbench::About::scene}});
  bench_.addAction({"snapshot",
                    tr("Save 3D snapshot..."),
                    {tr("Ctrl+Shift+E")},
                    "",
                    false,
                    [this](bool) { panel_->askWhere(); },
                    {{"fileMenu", 50, 50}}});
  bench_.addAction({"copySnapshot",
                    tr("Copy 3D snapshot"),
                    {},
                    "",
                    false,
                    [this](bool) { panel_->copy(); },
                    {{"fileMenu", 50, 50}}});
  snapshot_.setMeasured(
      [this](const Plan& plan) { return measuredError(bench_.document.meter.measured(), plan); });
  panel_->setSeen([this] { return seen(); });
  connect(panel_, &SnapshotPanel::requested, &snapshot_, &Snapshot::take);
  connect(&snapshot_, &Snapshot::saved, this, [this](const QString& path, int pictures) {
    tell(pictures == 1 ? tr("Saved %1").arg(path)
                       : tr("Saved %1 pictures, the last as %2").arg(pictures).arg(path));
  });
  connect(&snapshot_, &Snapshot::copied, this, [this] { tell(tr("Copied to the clipboard")); });
  connect(&snapshot_, &Snapshot::failed, this, [this](const QString& sentence) { warnUntilDone(sentence); });
  connectViews();
}

// Offers the size of the view in the panel.
void Snapshots::connectViews() {
  bench_.forEachVolumeView(
      [this](VolumeView* view) { connect(view, &View::pixelsChanged, panel_, [this] { tellSize(); }); });
  connect(&bench_, &Workbench::drawn, panel_, [this] { tellSize(); });
  connect(&session_, &Session::workspaceChanged, panel_,
          [this](const Workspace& before, const Workspace& after) {
            if (sceneViewOf(before) != sceneViewOf(after)) tellSize();
          });
}

void Snapshots::tellSize() {
  if (bench_.view()->isVisible()) panel_->setViewSize(bench_.view()->pixels());
}

std::optional<SnapshotSeen> Snapshots::seen() {
  if (!session_.series()) {
    warn(tr("Open a series first."));
    return {};
  }
  const ViewId view = sceneViewOf(session_.workspace());
  const DrawnScenes& drawn = bench_.document.drawn;
  const TissueLeft::Entry* tissue = drawn.tissue(view);
  return SnapshotSeen{drawn.series(view), bench_.sceneInView(),
                      segmentsInPicture(drawn.segments(view), tissue ? tissue->key.shown : TissueShown{}),
                      namesHidden()};
}

}  // namespace

std::unique_ptr<Feature> makeSnapshots(Workbench& bench) { return std::make_unique<Snapshots>(bench); }

}  // namespace volumen
