#include "results/text/text.h"
#include "ui/features/exporting.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Saves or copies pictures of the 3D view at any size and quality.
class Snapshots : public ExportFeature {
 public:
  explicit Snapshots(Workbench& bench);

 private:
  void connectViews();
  void tellSize();
  void askForFile();
  void askForFolder();
  std::optional<SnapshotRequest> wanted();
  void take(const SnapshotRequest& request, const PictureSink& sink);

  SnapshotPanel* panel_;
};

Snapshots::Snapshots(Workbench& bench) : ExportFeature(bench), panel_(new SnapshotPanel) {
  bench_.addDock({"snapshot",
                  tr("Snapshot"),
                  Workbench::scrolling(panel_),
                  {Qt::RightDockWidgetArea, 40, true, Workbench::About::scene}});
  bench_.addAction({"snapshot",
                    tr("Save 3D snapshot..."),
                    {tr("Ctrl+Shift+E")},
                    "",
                    false,
                    [this](bool) { askForFile(); },
                    {{"fileMenu", 50, 50}}});
  const auto copy = [this] {
    if (const auto request = wanted()) take(*request, clipboard());
  };
  bench_.addAction({"copySnapshot",
                    tr("Copy 3D snapshot"),
                    {},
                    "",
                    false,
                    [copy](bool) { copy(); },
                    {{"fileMenu", 50, 50}}});
  connect(panel_, &SnapshotPanel::saveWanted, this, &Snapshots::askForFile);
  connect(panel_, &SnapshotPanel::copyWanted, this, copy);
  connect(panel_, &SnapshotPanel::turntableWanted, this, &Snapshots::askForFolder);
  connectViews();
}

// Offers the size of the view in the panel.
void Snapshots::connectViews() {
  bench_.forEachVolumeView(
      [this](VolumeView* view) { connect(view, &View::pixelsChanged, panel_, [this] { tellSize(); }); });
  connect(&bench_, &Workbench::drawn, panel_, [this] { tellSize(); });
  whenChanged(session_, this, &Snapshots::tellSize, sceneViewOf);
}

void Snapshots::tellSize() {
  if (bench_.view()->isVisible()) panel_->setViewSize(bench_.view()->pixels());
}

// Returns nothing, after reporting why, if there is no scene.
std::optional<SnapshotRequest> Snapshots::wanted() {
  if (!session_.series()) {
    warn(tr("Open a series first."));
    return {};
  }
  return panel_->chosen(sceneNow(namesHidden()));
}

// Uses the view and options at this moment, whatever happens while the file dialog is open.
void Snapshots::askForFile() {
  const auto request = wanted();
  if (!request) return;
  const QString suffix = panel_->suffix(), name = fileName(request->seen.series->series);
  askForPath(
      {"snapshotDialog", tr("Save a snapshot"),
       suffix == QStringLiteral("png") ? tr("PNG pictures (*.png)") : tr("JPEG pictures (*.jpg *.jpeg)"),
       name + QLatin1Char('.') + suffix},
      [this, request = *request](const QString& path) { take(request, pictureFile(path)); });
}

void Snapshots::askForFolder() {
  auto request = wanted();
  if (!request) return;
  request->pictures = panel_->turntablePictures();
  const QString name = fileName(request->seen.series->series) + QLatin1Char('.') + panel_->suffix();
  askForPath({"turntableDialog", tr("Save the turntable in a folder"), {}, {}, QFileDialog::Directory},
             [this, request = *request, name](const QString& folder) {
               take(request, numberedFiles(folder + QLatin1Char('/') + name, request.pictures));
             });
}

void Snapshots::take(const SnapshotRequest& request, const PictureSink& sink) {
  run({tr("Rendering snapshot"), picturesOf(request), sink});
}

}  // namespace

std::unique_ptr<Feature> makeSnapshots(Workbench& bench) { return std::make_unique<Snapshots>(bench); }

}  // namespace volumen
