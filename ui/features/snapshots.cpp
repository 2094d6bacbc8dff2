#include "ui/controller/snapshot.h"
#include "ui/features/feature.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

// Pictures of the 3D view at any size and quality: to files, to the clipboard.
class Snapshots : public Feature {
 public:
  explicit Snapshots(Workbench& bench);

 private:
  void connectViews();
  void tellSize();
  void tellName();
  void take(SnapshotRequest request);

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
  connect(panel_, &SnapshotPanel::requested, this, &Snapshots::take);
  connect(&snapshot_, &Snapshot::saved, this, [this](const QString& path, int pictures) {
    tell(pictures == 1 ? tr("Saved %1").arg(path)
                       : tr("Saved %1 pictures, the last as %2").arg(pictures).arg(path));
  });
  connect(&snapshot_, &Snapshot::copied, this, [this] { tell(tr("Copied to the clipboard")); });
  connect(&snapshot_, &Snapshot::failed, this, [this](const QString& sentence) { warnUntilDone(sentence); });
  connectViews();
}

// What the panel offers: the size of the view, the name of the series.
void Snapshots::connectViews() {
  bench_.forEachVolumeView(
      [this](VolumeView* view) { connect(view, &View::pixelsChanged, panel_, [this] { tellSize(); }); });
  connect(&bench_, &Workbench::drawn, panel_, [this] { tellSize(); });
  connect(&session_, &Session::workspaceChanged, panel_,
          [this](const Workspace& before, const Workspace& after) {
            if (sceneViewOf(before) != sceneViewOf(after)) tellSize();
            if (showsOther(before, after)) tellName();
          });
  connect(&session_, &Session::preferencesChanged, panel_,
          [this](const Preferences& before, const Preferences& after) {
            if (before.hideNames != after.hideNames) tellName();
          });
}

void Snapshots::tellSize() {
  if (bench_.view()->isVisible()) panel_->setViewSize(bench_.view()->pixels());
}

void Snapshots::tellName() {
  if (const Series* series = seriesIn(session_.workspace(), session_.workspace().focus))
    panel_->setName(seriesText(*series).replace(QLatin1Char('/'), QLatin1Char('_')));
}

void Snapshots::take(SnapshotRequest request) {
  if (!session_.series()) return warn(tr("Open a series first."));
  const ViewId view = sceneViewOf(session_.workspace());
  const MadeTissue* tissue = session_.tissueDrawn(view);
  request.segments = segmentsInPicture(session_.segmentsDrawn(view), tissue ? tissue->shown : TissueShown{});
  snapshot_.take(session_.drawnSeries(view), bench_.sceneInView(), request);
}

}  // namespace

std::unique_ptr<Feature> makeSnapshots(Workbench& bench) { return std::make_unique<Snapshots>(bench); }

}  // namespace volumen
