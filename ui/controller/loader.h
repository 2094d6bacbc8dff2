#pragma once

#include <functional>
#include <memory>

#include "ui/controller/locate.h"
#include "ui/controller/open_intent.h"
#include "ui/controller/open_session.h"
#include "ui/data/loaded_series.h"
#include "ui/document/job_lane.h"

namespace volumen {

struct Study;

/// The scene of a named preset for a volume ("auto" chooses).
using MakeScene = std::function<Result<Scene>(const std::string& preset, const Volume& volume)>;

/// Opens paths and, beside that, loads series and makes presets: jobs, each kind one after the other.
class Loader : public QObject {
  Q_OBJECT
 public:
  Loader(Jobs& jobs, MakeScene makeScene, QObject* parent = nullptr);

  /// Where the volume of a series is found that is in memory already; it gives null where it is not.
  void useHeld(std::function<VolumePtr(const SeriesKey&)> held) { held_ = std::move(held); }
  void open(const QString& path, const OpenIntent& intent = {});
  /// The same for files that are not one path: ends in filesOpened() by the name given.
  void openFiles(const QString& name, const std::vector<std::string>& files, const OpenIntent& intent = {});
  void openSession(const QString& path);
  /// Looks for what a workspace misses in a folder.
  void locate(const MissingObjects& missing, const QString& folder);
  /// Gives up a load of another series that is under way. The scene is the one to show it by.
  void load(const Series& series, const std::optional<Scene>& scene = {});
  /// The same for one that is not shown yet, told by loadedAhead().
  void loadAhead(const Series& series);
  void makePreset(const QString& name, const LoadedSeriesPtr& series);
  /// Gives up all.
  void cancel();
  bool isBusy() const { return open_.isBusy() || load_.isBusy(); }
  /// Whether something is being opened, or loaded to be shown.
  bool isOpening() const { return open_.isBusy() || isLoading(); }
  /// Whether a series is being loaded to be shown.
  bool isLoading() const { return loading_ && !isAhead_; }
  /// Which one; none: none is.
  std::optional<SeriesKey> loadingToShow() const { return isLoading() ? loading_ : std::nullopt; }
  /// Gives up the load that is under way alone.
  void cancelLoad();

 Q_SIGNALS:
  /// Something is being opened in place of what is shown, or where nothing is.
  void openBegan();
  /// Of a series that is to be shown; it ends in seriesLoaded(), notLoaded() or loadGivenUp().
  void loadBegan(const volumen::Series& series);
  void loadGivenUp();
  /// A study withPictureStacks(), as the next one.
  void studyOpened(const QString& path, const std::shared_ptr<const volumen::Study>& study,
                   const volumen::OpenIntent& intent);
  void filesOpened(const QString& name, const std::shared_ptr<const volumen::Study>& study,
                   const volumen::OpenIntent& intent);
  void sessionOpened(const QString& path, const volumen::OpenedSession& session);
  void located(const volumen::Located& located);
  void seriesLoaded(const volumen::LoadedSeriesPtr& series, const std::optional<volumen::Scene>& scene);
  void loadedAhead(const volumen::LoadedSeriesPtr& series);
  /// It failed or was cancelled; not for what another series took the place of.
  void notLoaded(const volumen::SeriesKey& series);
  void presetReady(const QString& name, const volumen::Scene& scene, const volumen::VolumePtr& volume);
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);
  /// Nothing is asked for any more.
  void idle();

 private:
  template <class Tell>
  auto orFailed(Tell tell);
  void begin(const Series& series, bool isAhead);
  void take(const SeriesKey& series, const Result<LoadedSeriesPtr>& shown);
  void cancelled();

  const MakeScene makeScene_;
  std::function<VolumePtr(const SeriesKey&)> held_ = [](const SeriesKey&) { return VolumePtr(); };
  std::optional<SeriesKey> loading_;
  int loadJob_ = 0;
  std::optional<Scene> scene_;  // to show what is being loaded by
  bool isAhead_ = false;        // nobody waits for what is being loaded
  JobLane open_, load_;
};

}  // namespace volumen
