#include <algorithm>
#include <cmath>

#include "results/text/text.h"
#include "ui/exports/flat_pictures.h"
#include "ui/features/exporting.h"
#include "ui/panels/picture_dialog.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

// Exports the view in focus as a film: its stack, the time points of its series, or a full turn in 3D.
class Films : public ExportFeature {
 public:
  explicit Films(Workbench& bench);

 private:
  void ask();
  void askOfStack(FlatView& view);
  void askOfTurn();
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
  std::vector<std::shared_ptr<const Series>> steps;
  if (hasTimePoints(now.workspace, key))
    for (const Series* step : timePointsOf(now.workspace, key))
      steps.push_back(now.workspace.series.at(keyOf(*step)).series);
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
  auto* dialog = new PictureDialog(PicturesOf::turn, {}, seen, bench_.dialogParent());
  connect(dialog, &QDialog::accepted, this, [this, dialog, seen, asked = request] {
    SnapshotRequest turn = asked;
    const int width = dialog->look().edge;
    turn.size = {width, std::max(1, width * seen.height() / std::max(1, seen.width()))};
    turn.shown.letters = turn.shown.warnings = dialog->withTexts();
    turn.pictures = dialog->turnPictures();
    askWhere(*dialog, picturesOf(turn), turn.seen.series->series);
  });
  dialog->open();
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
