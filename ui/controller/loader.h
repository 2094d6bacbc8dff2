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

/// Makes the scene of a named preset for a volume ("auto" chooses).
using MakeScene = std::function<Result<Scene>(const std::string& preset, const Volume& volume)>;

/// Opens paths, loads series and makes presets, each as a job. Jobs of one kind run one after another.
class Loader : public QObject {
  Q_OBJECT
 public:
  Loader(Jobs& jobs, MakeScene makeScene, QObject* parent = nullptr);

  /// Sets the function that returns the volume of a series in memory, or null.
  void useHeld(std::function<VolumePtr(const SeriesKey&)> held) { held_ = std::move(held); }
  void open(const QString& path, const OpenIntent& intent = {});
  /// Opens files that are not one path; ends in filesOpened() with `name`.
  void openFiles(const QString& name, const std::vector<std::string>& files, const OpenIntent& intent = {});
  void openSession(const QString& path);
  /// Searches a folder for the missing objects of a workspace.
  void locate(const MissingObjects& missing, const QString& folder);
  /// Loads a series to show it with `scene`. Cancels the load of another series.
  void load(const Series& series, const std::optional<Scene>& scene = {});
  /// Loads a series that is not shown yet; ends in loadedAhead().
  void loadAhead(const Series& series);
  void makePreset(const QString& name, const LoadedSeriesPtr& series);
  /// Cancels everything.
  void cancel();
  bool isBusy() const { return open_.isBusy() || load_.isBusy(); }
  /// Returns whether something is being opened, or loaded to be shown.
  bool isOpening() const { return open_.isBusy() || isLoading(); }
  /// Returns whether a series is being loaded to be shown.
  bool isLoading() const { return loading_ && !isAhead_; }
  /// Returns the series being loaded to be shown, if any.
  std::optional<SeriesKey> loadingToShow() const { return isLoading() ? loading_ : std::nullopt; }
  /// Cancels only the load in progress.
  void cancelLoad();

 Q_SIGNALS:
  /// Something is being opened to replace what is shown, or in an empty window.
  void openBegan();
  /// Sent before a series to be shown is read. Receivers make room in memory.
  void aboutToRead(const volumen::Series& series);
  /// A series to be shown is being loaded; this ends in seriesLoaded(), notLoaded() or loadGivenUp().
  void loadBegan(const volumen::Series& series);
  void loadGivenUp();
  /// `study` is the study after withPictureStacks(), here and in filesOpened().
  void studyOpened(const QString& path, const std::shared_ptr<const volumen::Study>& study,
                   const volumen::OpenIntent& intent);
  void filesOpened(const QString& name, const std::shared_ptr<const volumen::Study>& study,
                   const volumen::OpenIntent& intent);
  void sessionOpened(const QString& path, const volumen::OpenedSession& session);
  void located(const volumen::Located& located);
  void seriesLoaded(const volumen::LoadedSeriesPtr& series, const std::optional<volumen::Scene>& scene);
  void loadedAhead(const volumen::LoadedSeriesPtr& series);
  /// The load failed or was cancelled; not sent if another series replaced it.
  void notLoaded(const volumen::SeriesKey& series);
  void presetReady(const QString& name, const volumen::Scene& scene, const volumen::VolumePtr& volume);
  /// A sentence; not sent for cancelled work.
  void failed(const QString& sentence);
  /// No request is left.
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
  std::optional<Scene> scene_;  // to show the loading series with
  bool isAhead_ = false;        // whether the loading series is not to be shown yet
  JobLane open_, load_;
};

}  // namespace volumen
