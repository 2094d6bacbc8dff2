#include "ui/controller/loader.h"

#include <QElapsedTimer>
#include <utility>

#include "viewer/plan/default_window.h"
#include "viewer/scene/automatic.h"
#include "viewer/slice/first_window.h"

namespace volumen {

namespace {
constexpr int progressEveryMs = 50;

void setWindow(ShownSeries& shown) {
  VolumeFacts facts;
  const std::vector<float> p = percentiles(*shown.volume, {1, 999});
  facts.p01 = p[0], facts.p999 = p[1];
  const std::vector<Window>& files = shown.volume->attributes().windows;
  if (!files.empty()) facts.fileWindow = files.front();
  shown.window = defaultWindow(facts);
  if (files.empty()) shown.flatWindow = firstWindow(*shown.volume, shown.series.unit);
  shown.valueSpread = p[1] > p[0] ? double(p[1]) - p[0] : 1;
}
}  // namespace

Loader::Loader(MakeScene makeScene, QObject* parent) : QObject(parent), makeScene_(std::move(makeScene)) {
  for (QThreadPool* pool : {&openPool_, &loadPool_}) pool->setMaxThreadCount(1);
}

Loader::~Loader() {
  cancel();
  for (QThreadPool* pool : {&openPool_, &loadPool_}) pool->waitForDone();
}

void Loader::cancel() {
  for (CancelToken* token : {&cancel_, &loadCancel_}) {
    token->cancel();
    *token = CancelToken();
  }
  scene_.reset();
  if (const auto given = std::exchange(loading_, {})) Q_EMIT notLoaded(*given);
}

// Runs a function on the thread of this object, unless the job was cancelled by then.
template <class Function>
void Loader::tell(const CancelToken& cancel, Function function) {
  QMetaObject::invokeMethod(
      this,
      [cancel, function] {
        if (!cancel.cancelled()) function();
      },
      Qt::QueuedConnection);
}

Progress Loader::progressTeller(const CancelToken& cancel) {
  auto clock = std::make_shared<QElapsedTimer>();
  return [this, cancel, clock](const char* what, std::size_t done, std::size_t total) {
    if (clock->isValid() && clock->elapsed() < progressEveryMs) return;
    clock->start();
    tell(cancel, [this, text = QString::fromUtf8(what), done, total] {
      Q_EMIT progressed(text, qint64(done), qint64(total));
    });
  };
}

void Loader::start(QThreadPool& pool, const CancelToken& cancel, Job job) {
  if (underWay_++ == 0) Q_EMIT busyChanged(true);
  pool.start([this, cancel, job = std::move(job)] {
    if (!cancel.cancelled()) job(cancel, progressTeller(cancel));
    QMetaObject::invokeMethod(
        this,
        [this] {
          if (--underWay_ == 0) Q_EMIT busyChanged(false);
        },
        Qt::QueuedConnection);
  });
}

void Loader::open(const QString& path, const OpenIntent& intent) {
  start(openPool_, cancel_, [this, path, intent](const CancelToken& cancel, const Progress& progress) {
    Result<Study> study = openStudy(path.toStdString(), progress, cancel);
    if (!study)
      return tell(cancel, [this, text = QString::fromStdString(study.message())] { Q_EMIT failed(text); });
    const auto shared = std::make_shared<const Study>(std::move(*study));
    tell(cancel, [this, path, shared, intent] { Q_EMIT studyOpened(path, shared, intent); });
  });
}

void Loader::openFiles(const QString& name, const std::vector<std::string>& files, const OpenIntent& intent) {
  start(openPool_, cancel_, [this, name, files, intent](const CancelToken& cancel, const Progress& progress) {
    Result<Study> study = volumen::openFiles(files, progress, cancel);
    if (!study)
      return tell(cancel, [this, text = QString::fromStdString(study.message())] { Q_EMIT failed(text); });
    const auto shared = std::make_shared<const Study>(std::move(*study));
    tell(cancel, [this, name, shared, intent] { Q_EMIT filesOpened(name, shared, intent); });
  });
}

void Loader::openSession(const QString& path) {
  start(openPool_, cancel_, [this, path](const CancelToken& cancel, const Progress& progress) {
    const Result<OpenedSession> session = volumen::openSession(path.toStdString(), progress, cancel);
    tell(cancel, [this, path, session] {
      if (session)
        Q_EMIT sessionOpened(path, *session);
      else
        Q_EMIT failed(QString::fromStdString(session.message()));
    });
  });
}

void Loader::locate(const MissingObjects& missing, const QString& folder) {
  start(openPool_, cancel_, [this, missing, folder](const CancelToken& cancel, const Progress& progress) {
    const Result<Located> found = volumen::locate(missing, folder.toStdString(), progress, cancel);
    tell(cancel, [this, found] {
      if (found)
        Q_EMIT located(*found);
      else
        Q_EMIT failed(QString::fromStdString(found.message()));
    });
  });
}

void Loader::cancelLoad() {
  loadCancel_.cancel();
  loadCancel_ = CancelToken();
  loading_.reset();
  scene_.reset();
}

void Loader::load(const Series& series, const std::optional<Scene>& scene) {
  begin(series, false);
  if (scene) scene_ = scene;
}

void Loader::loadAhead(const Series& series) { begin(series, true); }

void Loader::begin(const Series& series, bool isAhead) {
  if (loading_ == keyOf(series)) {
    isAhead_ = isAhead_ && isAhead;
    return;
  }
  cancelLoad();
  loading_ = keyOf(series);
  isAhead_ = isAhead;
  start(loadPool_, loadCancel_, [this, series](const CancelToken& cancel, const Progress& progress) {
    const auto fail = [&](const std::string& sentence) {
      tell(cancel, [this, key = keyOf(series), text = QString::fromStdString(sentence)] {
        loading_.reset();
        Q_EMIT notLoaded(key);
        Q_EMIT failed(text);
      });
    };
    Result<Loaded> loaded = loadSeries(series, progress, cancel);
    if (!loaded) return fail(loaded.message());
    progress("preparing the display", 0, 0);
    auto shown = std::make_shared<ShownSeries>();
    shown->series = series;
    shown->volume = loaded->drawn;
    shown->warnings = loaded->warnings;
    shown->histogram = histogram(*loaded->drawn);
    setWindow(*shown);
    if (series.unit.empty()) shown->usual = usualRange(*loaded->drawn);
    Result<Scene> scene = makeScene_("auto", *loaded->drawn);
    if (!scene) return fail(scene.message());
    shown->firstScene = std::move(*scene);
    tell(cancel, [this, shown] {
      loading_.reset();
      if (isAhead_)
        Q_EMIT loadedAhead(shown);
      else
        Q_EMIT seriesLoaded(shown, std::exchange(scene_, {}));
    });
  });
}

void Loader::makePreset(const QString& name, VolumePtr volume) {
  start(loadPool_, cancel_, [this, name, volume](const CancelToken& cancel, const Progress&) {
    Result<Scene> scene = makeScene_(name.toStdString(), *volume);
    if (!scene)
      return tell(cancel, [this, text = QString::fromStdString(scene.message())] { Q_EMIT failed(text); });
    tell(cancel, [this, name, volume, made = *scene] { Q_EMIT presetReady(name, made, volume); });
  });
}

}  // namespace volumen
