#include "io/load.h"
#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

// Puts loaded studies into the list and the views, and reports failures.
class Loading : public Feature {
 public:
  explicit Loading(Workbench& bench);

 private:
  void showStudy(const QString& path, const std::shared_ptr<const Study>& study, const OpenIntent& intent);
};

Loading::Loading(Workbench& bench) : Feature(bench) {
  Loader& loader = bench_.document.loader;
  connect(&loader, &Loader::studyOpened, this, &Loading::showStudy);
  connect(&loader, &Loader::seriesLoaded, this,
          [this](const LoadedSeriesPtr& series, const std::optional<Scene>& scene) {
            session_.setLoading({});
            session_.take(series, bench_.document.opener.arrangedFor(series->series));
            if (scene) session_.edit(tr("Open scene"), *scene);
          });
  connect(&loader, &Loader::failed, this, [this](const QString& sentence) { bench_.banner.add(sentence); });
  connect(&loader, &Loader::notLoaded, &grid_, &ViewGrid::giveUpWaiting);
  connect(&loader, &Loader::aboutToRead, this,
          [this](const Series& series) { session_.pool().makeRoomFor(bytesToLoad(series)); });
  connect(&loader, &Loader::loadBegan, this,
          [this](const Series& series) { session_.setLoading(keyOf(series)); });
  // Queued, because the caller that cancelled may be about to load another series or to close all.
  const auto askSoon = [this] {
    QMetaObject::invokeMethod(&session_, &Session::askForMissing, Qt::QueuedConnection);
  };
  connect(&loader, &Loader::loadGivenUp, this, [this, askSoon] {
    session_.setLoading({});
    askSoon();
  });
  connect(&loader, &Loader::notLoaded, this, [this, askSoon](const SeriesKey& series) {
    session_.setNotLoaded(series);
    askSoon();
  });
  connect(&session_, &Session::seriesNeeded, &loader,
          [&loader](const Series& series) { loader.load(series); });
}

void Loading::showStudy(const QString& path, const std::shared_ptr<const Study>& study,
                        const OpenIntent& intent) {
  bench_.document.opener.list(path, study);
  QStringList details = refusedTexts(study->refused);
  for (const Other& other : study->other)
    details << pathText(other.path) + QStringLiteral(": ") + shownText(other.kind);
  const bool hasPictures = !study->volumes.empty() || !study->images.empty();
  if (!hasPictures && !study->derived.empty()) return;  // the list shows them
  if (!hasPictures)
    return bench_.banner.add(tr("No images found in %1.").arg(pathText(path.toStdString())), details);
  if (!study->refused.empty()) bench_.banner.add(unreadText(*study), details);
  bench_.document.recent.add(path);
  if (!intent.isShown) return;
  if (!std::exchange(*intent.isShown, true))
    bench_.document.opener.showFirst(*study, intent.scene);
  else if (!intent.scene)
    bench_.document.opener.showFused(*study);
}

}  // namespace

std::unique_ptr<Feature> makeLoading(Workbench& bench) { return std::make_unique<Loading>(bench); }

}  // namespace volumen
