#include "ui/controller/loader.h"

#include <QDir>
#include <QFileInfo>
#include <algorithm>
#include <utility>

#include "io/archive/fetched_studies.h"
#include "io/curved.h"
#include "io/paths/open_path.h"
#include "io/load.h"
#include "io/open.h"
#include "results/text/text.h"
#include "ui/data/picture_stacks.h"
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
Result<std::shared_ptr<LoadedSeries>> loadWithoutScene(const Series& series, const VolumePtr& source,
                                                       const Job& job) {
  Result<Loaded> loaded = series.curved ? loadCurved(series, source, job.progress(), job.cancel())
                                        : loadSeries(series, job.progress(), job.cancel());
  if (!loaded) return loaded.error();
  job.tell(Loader::tr("preparing the display"), -1);
  auto shown = std::make_shared<LoadedSeries>();
  shown->series = series;
  shown->volume = loaded->drawn;
  shown->origins = loaded->origins, shown->places = loaded->places;
  shown->warnings = loaded->warnings;
  shown->histogram = histogram(*loaded->drawn);
  setWindow(*shown);
  if (series.unit.empty()) shown->usual = usualRange(*loaded->drawn);
  return shown;
}

Result<LoadedSeriesPtr> loadShown(const Series& series, const VolumePtr& source, const MakeScene& makeScene,
                                  const Job& job) {
  const auto shown = loadWithoutScene(series, source, job);
  if (!shown) return shown.error();
  Result<Scene> scene = makeScene("auto", *(*shown)->volume);
  if (!scene) return scene.error();
  (*shown)->firstScene = withUptakeWindow(std::move(*scene), series);
  return LoadedSeriesPtr(*shown);
}

}  // namespace

Result<LoadedSeriesPtr> loadForSlices(const Series& series, const Job& job) {
  const auto shown = loadWithoutScene(series, nullptr, job);
  if (!shown) return shown.error();
  return LoadedSeriesPtr(*shown);
}

Loader::Loader(Session& session, Jobs& jobs, MakeScene makeScene, QObject* parent)
    : QObject(parent), session_(session), makeScene_(std::move(makeScene)), open_(&jobs), load_(&jobs) {
  connect(&session_, &Session::needsChanged, this, &Loader::update);
  for (JobLane* lane : {&open_, &load_})
    lane->whenIdle([this] {
      update();
      if (!isBusy()) Q_EMIT idle();
    });
}

void Loader::cancel() {
  open_.giveUpAll();
  load_.giveUpAll();
  end({});
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

void Loader::openFiles(const QString& name, const OpenIntent& intent) {
  const QString folder = intent.files.empty()
                             ? QString()
                             : QFileInfo(QString::fromStdString(intent.files.front())).dir().dirName();
  const bool isJoining = intent.how == OpenHow::joining;
  if (isJoining) open_.giveUpWaiting(joining_[name]);
  const int job = open_.run(
      opening(folder),
      [files = intent.files](const Job& open) {
        useFetched(files);
        return shared(volumen::openFiles(files, open.progress(), open.cancel()));
      },
      orFailed([this, name, intent](const auto& study) { Q_EMIT filesOpened(name, study, intent); }));
  if (isJoining) joining_[name] = job;
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

// Returns the most needed series that may be read now. A failure holds as long as the series is needed,
// unless it is requested anew or some time has passed.
std::optional<NeededSeries> Loader::next() {
  const std::vector<NeededSeries> needed =
      neededSeries(session_.workspace(), session_.requests(), session_.pool());
  const auto find = [&](const SeriesKey& key) {
    return std::ranges::find(needed, key, [](const NeededSeries& n) { return keyOf(*n.series); });
  };
  std::erase_if(failures_, [&](const Failure& failure) {
    return find(failure.series) == needed.end() || session_.requests().shows(failure.series);
  });
  const auto hasFailed = [&](const NeededSeries& n) {
    const auto failure = std::ranges::find(failures_, keyOf(*n.series), &Failure::series);
    return failure != failures_.end() &&
           (!failure->since.isValid() || !failure->since.hasExpired(tryAgainMs));
  };
  const auto mayBegin = [&](const NeededSeries& n) {
    return !hasFailed(n) && (n.reason != NeededFor::later || !open_.isBusy());
  };
  const auto first = std::ranges::find_if(needed, mayBegin);
  const auto now = loading_ ? find(keyOf(*loading_->series)) : needed.end();
  if (first == needed.end() && now == needed.end()) return {};
  // The load in progress goes on unless another series is more urgent.
  const bool goesOn = now != needed.end() && (first == needed.end() || now->reason <= first->reason);
  return goesOn ? *now : *first;
}

// Reads the most needed series, and no other.
void Loader::update() {
  if (isTaking_) return;
  const std::optional<NeededSeries> wanted = next();
  const bool goesOn = wanted && loading_ && keyOf(*wanted->series) == keyOf(*loading_->series);
  if (!goesOn && loading_) load_.giveUp(loadJob_);
  loading_ = wanted;
  if (!goesOn && wanted) begin(*wanted->series);
  tellLoading();
}

void Loader::tellLoading() {
  const std::shared_ptr<const Series> now = loading(), before = std::exchange(told_, now);
  const bool isSame = now && before ? keyOf(*now) == keyOf(*before) : now == before;
  if (!isSame) Q_EMIT loadingChanged();
}

void Loader::begin(const Series& series) {
  if (isLoading()) session_.pool().makeRoomFor(bytesToLoad(series));
  const LoadedSeriesPtr source =
      series.curved ? session_.pool().find({keyOf(sourceOf(series)), {}}) : nullptr;
  loadJob_ = load_.run(
      {tr("Opening"), seriesText(series)},
      [series, volume = source ? source->volume : nullptr, makeScene = makeScene_](const Job& job) {
        return loadShown(series, volume, makeScene, job);
      },
      [this](const Result<LoadedSeriesPtr>& shown) { take(shown); }, [this] { end({}); });
}

void Loader::take(const Result<LoadedSeriesPtr>& shown) {
  if (!shown) return end(QString::fromStdString(shown.message()));
  const SeriesKey key = keyOf((*shown)->series);
  std::erase_if(failures_, [&](const Failure& failure) { return failure.series == key; });
  loading_.reset();
  isTaking_ = true;
  if (session_.requests().shows(key)) {
    std::optional<Scene> scene;
    session_.request([&](Requests& r) { scene = std::exchange(r.show, {})->scene; });
    Q_EMIT requestLoaded(*shown, scene);
  } else {
    session_.keep(*shown);
    if (!session_.pool().peek({key, {}})) failures_.push_back({key, {}});  // it had no room
  }
  isTaking_ = false;
  update();
}

// Ends the load in progress without a series. If `whyNot` is empty, the user cancelled it.
void Loader::end(const QString& whyNot) {
  if (!loading_) return;
  const SeriesKey key = keyOf(*std::exchange(loading_, {})->series);
  const auto isIts = [&](const Failure& failure) { return failure.series == key; };
  const bool isNews = std::erase_if(failures_, isIts) == 0;
  failures_.push_back({key, {}});
  if (!whyNot.isEmpty()) failures_.back().since.start();
  isTaking_ = true;
  session_.request([&](Requests& r) {
    if (r.shows(key)) r.show.reset();
  });
  tellLoading();
  Q_EMIT notLoaded(key);
  if (isNews && !whyNot.isEmpty()) Q_EMIT failed(whyNot);
  isTaking_ = false;
  QMetaObject::invokeMethod(this, &Loader::update, Qt::QueuedConnection);
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
