#include <algorithm>
#include <cmath>

#include "results/segments/tissue.h"
#include "results/text/text.h"
#include "ui/exports/flat_pictures.h"
#include "ui/features/exporting.h"
#include "ui/panels/picture_dialog.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

// Exports the view in focus as a film: its stack, the time points of its series, also in 3D, or a full turn.
class Films : public ExportFeature {
 public:
  explicit Films(Workbench& bench);

 private:
  void ask();
  void askOfStack(FlatView& view);
  void askOfTurn();
  SnapshotSteps stepsIn3d() const;
  void askWhere(const PictureDialog& dialog, const PictureMakerPtr& pictures, const Series& series);
};

// Returns the stops of the places that a dialog chose.
std::vector<PictureStop> stopsOf(const PictureDialog& dialog, const PictureStop& now,
                                 const LoadedSeriesPtr& shown,
                                 const std::vector<std::shared_ptr<const Series>>& steps) {
  std::vector<PictureStop> stops;
  for (const auto& [number, place] : dialog.places()) {
    stops.push_back(now);
    stops.back().workspace = dialog.isOfTimePoints()
                                 ? withTimePoint(now.workspace, now.view, keyOf(*steps[std::size_t(place)]))
                                 : withPlace(now.workspace, now.view, shown, place);
    stops.back().label.number = number;
  }
  return stops;
}

// Returns the time points of a series in order; none if there is only one.
std::vector<std::shared_ptr<const Series>> stepsOf(const Workspace& workspace, const SeriesKey& key) {
  std::vector<std::shared_ptr<const Series>> steps;
  if (hasTimePoints(workspace, key))
    for (const Series* step : timePointsOf(workspace, key))
      steps.push_back(workspace.series.at(keyOf(*step)).series);
  return steps;
}

// Returns the request for the time points that a dialog chose, drawn as the one in view. Segments are of one
// time point alone.
SnapshotRequest requestOfSteps(SnapshotRequest request, const PictureDialog& dialog,
                               const SnapshotSteps& of) {
  SnapshotSeen& seen = request.seen;
  seen.scene = drawnAsTheWhole(std::move(seen.scene), seen.series->window, seen.series->valueSpread,
                               seen.series->volume->geometry());
  seen.scene.segments.clear();
  seen.segments = {};
  request.steps = of;
  request.steps.series.clear();
  for (const auto& [number, place] : dialog.places())
    request.steps.series.push_back(of.series[std::size_t(place)]);
  return request;
}

Films::Films(Workbench& bench) : ExportFeature(bench) {
  bench_.addAction(
      {"saveFilm", tr("Film..."), {}, "", false, [this](bool) { ask(); }, {{"picturesMenu", 10}}});
}

void Films::ask() {
  auto* flat = qobject_cast<FlatView*>(grid_.viewShown());
  if (flat && flat->shown()) return askOfStack(*flat);
  if (qobject_cast<VolumeView*>(grid_.viewShown()) && session_.series()) return askOfTurn();
  warn(session_.workspace().series.empty() ? tr("Open a series first.")
                                           : tr("Click a view that shows a picture first."));
}

// Uses the view as it is now, whatever happens while dialogs are open.
void Films::askOfStack(FlatView& view) {
  const PictureStop now = heldNow({session_.workspace(), view.id()}, session_);
  const SeriesKey key = now.workspace.view(view.id()).series;
  const std::vector<std::shared_ptr<const Series>> steps = stepsOf(now.workspace, key);
  auto* dialog = new PictureDialog(PicturesOf::film, view.stack(), view.size(), bench_.dialogParent(),
                                   int(steps.size()));
  const double rate = seriesIn(now.workspace, view.id())->cine.framesPerSecond;
  if (rate > 0) dialog->setPerSecond(int(std::lround(rate)));
  connect(dialog, &QDialog::accepted, this, [this, dialog, now, steps, shown = view.shown()] {
    askWhere(*dialog, flatPictures(grid_, stopsOf(*dialog, now, shown, steps), dialog->look()),
             *seriesIn(now.workspace, now.view));
  });
  dialog->open();
}

void Films::askOfTurn() {
  SnapshotRequest request;
  request.seen = sceneNow(true);
  request.quality = Quality::standard;
  const QSize seen = bench_.view()->pixels();
  const SnapshotSteps steps = stepsIn3d();
  auto* dialog =
      new PictureDialog(PicturesOf::turn, {}, seen, bench_.dialogParent(), int(steps.series.size()));
  connect(dialog, &QDialog::accepted, this, [this, dialog, seen, steps, asked = request] {
    SnapshotRequest turn = asked;
    const int width = dialog->look().edge;
    turn.size = {width, std::max(1, width * seen.height() / std::max(1, seen.width()))};
    turn.shown.letters = turn.shown.warnings = dialog->withTexts();
    turn.pictures = dialog->turnPictures();
    if (dialog->isOfTimePoints()) turn = requestOfSteps(std::move(turn), *dialog, steps);
    askWhere(*dialog, picturesOf(turn), turn.seen.series->series);
  });
  dialog->open();
}

// Returns the time points of the 3D view; none where it shows tissue by segments, which are of one of them.
SnapshotSteps Films::stepsIn3d() const {
  const Workspace& workspace = session_.workspace();
  const ViewId view = sceneViewOf(workspace);
  const TissueLeft::Entry* tissue = bench_.document.drawn.tissue(view);
  if (tissue && tissue->key.shown.where != TissueShown::Where::everywhere) return {};
  const SeriesKey key = workspace.view(view).series;
  return {stepsOf(workspace, key), session_.maskOf(key), tissue && tissue->key.withoutTable};
}

void Films::askWhere(const PictureDialog& dialog, const PictureMakerPtr& pictures, const Series& series) {
  const HidingNames hiding(true);
  const QString ending = dialog.filmEnding();
  const QString filter =
      ending == QStringLiteral(".mp4") ? tr("MP4 films (*.mp4)") : tr("Animated PNG films (*.png *.apng)");
  askForPath({"filmDialog", tr("Save the film"), filter, fileName(series) + ending},
             [this, pictures, perSecond = dialog.perSecond()](const QString& path) {
               run({tr("Saving a film"), pictures, filmFile(path, int(pictures->count()), perSecond)});
             });
}

}  // namespace

std::unique_ptr<Feature> makeFilms(Workbench& bench) { return std::make_unique<Films>(bench); }

}  // namespace volumen
