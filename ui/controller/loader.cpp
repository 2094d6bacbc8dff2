#include "ui/controller/loader.h"

#include <QDir>
#include <QFileInfo>
#include <algorithm>
#include <utility>

#include "io/curved.h"
#include "io/index/index_path.h"
#include "io/load.h"
#include "io/open.h"
#include "ui/data/picture_stacks.h"
#include "ui/workspace/text.h"
#include "ui/workspace/windows.h"
#include "viewer/plan/default_window.h"
#include "viewer/scene/automatic.h"
#include "viewer/scene/presets.h"
#include "viewer/slice/first_window.h"

namespace volumen {

namespace {
void setWindow(LoadedSeries& shown) {
  VolumeFacts facts;
  const std::vector<float> p = percentiles(*shown.volume, {1, 999});
  facts.p01 = p[0], facts.p999 = p[1];
  const std::vector<Window>& files = shown.volume->attributes().windows;
  if (!files.empty()) facts.fileWindow = files.front();
  shown.window = defaultWindow(facts);
  if (files.empty()) shown.flatWindow = firstWindow(*shown.volume, shown.series.unit);
  shown.valueSpread = p[1] > p[0] ? double(p[1]) - p[0] : 1;
}

JobName opening(const QString& fileName) {
  return {Loader::tr("Opening"), shownText(fileName.toStdString())};
}

// Returns the study in the form that is shown.
Result<std::shared_ptr<const Study>> shared(Result<Study> study) {
  if (!study) return study.error();
  return std::make_shared<const Study>(withPictureStacks(std::move(*study)));
}

// `source` is the volume of a series along a curve, if it is in memory.
Result<LoadedSeriesPtr> loadShown(const Series& series, const VolumePtr& source, const MakeScene& makeScene,
                                  const Job& job) {
  Result<Loaded> loaded = series.curved ? loadCurved(series, source, job.progress(), job.cancel())
                                        : loadSeries(series, job.progress(), job.cancel());
  if (!loaded) return loaded.error();
  job.tell(Loader::tr("preparing the display"), -1);
  auto shown = std::make_shared<LoadedSeries>();
  shown->series = series;
  shown->volume = loaded->drawn;
  shown->warnings = loaded->warnings;
  shown->histogram = histogram(*loaded->drawn);
  setWindow(*shown);
  if (series.unit.empty()) shown->usual = usualRange(*loaded->drawn);
  Result<Scene> scene = makeScene("auto", *loaded->drawn);
  if (!scene) return scene.error();
  shown->firstScene = withUptakeWindow(std::move(*scene), series);
  return LoadedSeriesPtr(shown);
}

}  // namespace

Loader::Loader(Jobs& jobs, MakeScene makeScene, QObject* parent)
    : QObject(parent), makeScene_(std::move(makeScene)), open_(&jobs), load_(&jobs) {
  for (JobLane* lane : {&open_, &load_})
    lane->whenIdle([this] {
      if (!isBusy()) Q_EMIT idle();
    });
}

void Loader::cancel() {
  open_.giveUpAll();
  load_.giveUpAll();
  cancelled();
}

void Loader::cancelled() {
  scene_.reset();
  if (const auto given = std::exchange(loading_, {})) Q_EMIT notLoaded(*given);
}

// Passes the result of a job to `tell`, or reports its failure.
template <class Tell>
auto Loader::orFailed(Tell tell) {
  return [this, tell](const auto& made) {
    if (made)
      tell(*made);
    else
      Q_EMIT failed(QString::fromStdString(made.message()));
  };
}

void Loader::open(const QString& path, const OpenIntent& intent) {
  open_.run(
      opening(QFileInfo(path).fileName()),
      [path](const Job& job) { return shared(openPath(path.toStdString(), job.progress(), job.cancel())); },
      orFailed([this, path, intent](const auto& study) { Q_EMIT studyOpened(path, study, intent); }));
  Q_EMIT openBegan();
}

void Loader::openFiles(const QString& name, const std::vector<std::string>& files, const OpenIntent& intent) {
  const QString folder =
      files.empty() ? QString() : QFileInfo(QString::fromStdString(files.front())).dir().dirName();
  open_.run(
      opening(folder),
      [files](const Job& job) { return shared(volumen::openFiles(files, job.progress(), job.cancel())); },
      orFailed([this, name, intent](const auto& study) { Q_EMIT filesOpened(name, study, intent); }));
  if (intent.how == OpenHow::instead) Q_EMIT openBegan();
}

void Loader::openSession(const QString& path) {
  open_.run(
      opening(QFileInfo(path).fileName()),
      [path](const Job& job) {
        return volumen::openSession(path.toStdString(), job.progress(), job.cancel());
      },
      orFailed([this, path](const OpenedSession& session) { Q_EMIT sessionOpened(path, session); }));
}

void Loader::locate(const MissingObjects& missing, const QString& folder) {
  open_.run(
      tr("Looking for files"),
      [missing, folder](const Job& job) {
        return volumen::locate(missing, folder.toStdString(), job.progress(), job.cancel());
      },
      orFailed([this](const Located& found) { Q_EMIT located(found); }));
}

void Loader::cancelLoad() {
  load_.giveUp(loadJob_);
  scene_.reset();
  if (std::exchange(loading_, {})) Q_EMIT loadGivenUp();
}

void Loader::load(const Series& series, const std::optional<Scene>& scene) {
  begin(series, false);
  if (scene) scene_ = scene;
}

void Loader::loadAhead(const Series& series) { begin(series, true); }

void Loader::begin(const Series& series, bool isAhead) {
  if (loading_ == keyOf(series)) {
    if (isAhead_ && !isAhead) Q_EMIT loadBegan(series);
    isAhead_ = isAhead_ && isAhead;
    return;
  }
  cancelLoad();
  loading_ = keyOf(series);
  isAhead_ = isAhead;
  if (!isAhead) Q_EMIT aboutToRead(series);
  loadJob_ = load_.run(
      {tr("Opening"), seriesText(series)},
      [series, source = series.curved ? held_(keyOf(sourceOf(series))) : nullptr,
       makeScene = makeScene_](const Job& job) { return loadShown(series, source, makeScene, job); },
      [this, key = keyOf(series)](const Result<LoadedSeriesPtr>& shown) { take(key, shown); },
      [this] { cancelled(); });
  if (!isAhead) Q_EMIT loadBegan(series);
}

void Loader::take(const SeriesKey& series, const Result<LoadedSeriesPtr>& shown) {
  loading_.reset();
  if (!shown) {
    Q_EMIT notLoaded(series);
    Q_EMIT failed(QString::fromStdString(shown.message()));
  } else if (isAhead_) {
    Q_EMIT loadedAhead(*shown);
  } else {
    Q_EMIT seriesLoaded(*shown, std::exchange(scene_, {}));
  }
}

void Loader::makePreset(const QString& name, const LoadedSeriesPtr& series) {
  load_.run(
      tr("Making the preset"),
      [name = name.toStdString(), series, makeScene = makeScene_](const Job&) {
        Result<Scene> scene = makeScene(name, *series->volume);
        // A user's own preset keeps the window it was saved with.
        const bool isOwn = name != "auto" && std::ranges::find(presetNames(), name) == presetNames().end();
        if (scene && !isOwn) *scene = withUptakeWindow(*scene, series->series);
        return scene;
      },
      orFailed(
          [this, name, series](const Scene& scene) { Q_EMIT presetReady(name, scene, series->volume); }));
}

}  // namespace volumen
