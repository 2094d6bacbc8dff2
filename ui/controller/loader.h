#pragma once

#include <QElapsedTimer>
#include <functional>
#include <map>
#include <memory>

#include "results/series/loaded_series.h"
#include "ui/controller/locate.h"
#include "ui/controller/open_intent.h"
#include "ui/controller/open_session.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/needed_series.h"
#include "ui/workspace/session.h"

namespace volumen {

struct Study;

/// Makes the scene of a named preset for a volume ("auto" chooses).
using MakeScene = std::function<Result<Scene>(const std::string& preset, const Volume& volume)>;

/// Loads a series for slices: it has no scene. For the thread of a job.
Result<LoadedSeriesPtr> loadForSlices(const Series& series, const Job& job);

/// Opens paths, loads the neededSeries() of the session and makes presets, each as a job. Jobs of one kind
/// run one after another.
class Loader : public QObject {
  Q_OBJECT
 public:
  /// Time after which a series on screen that could not be read is read again, at the next change.
  static constexpr int tryAgainMs = 5000;

  Loader(Session& session, Jobs& jobs, MakeScene makeScene, QObject* parent = nullptr);

  void open(const QString& path, const OpenIntent& intent = {});
  /// Opens the list of files in an intent. Ends in filesOpened() with `name`. If several intents with the
  /// same name only join the list (OpenHow::joining), only the last one is read.
  void openFiles(const QString& name, const OpenIntent& intent);
  void openSession(const QString& path);
  /// Searches a folder for the missing objects of a workspace.
  void locate(const MissingObjects& missing, const QString& folder);
  void makePreset(const QString& name, const LoadedSeriesPtr& series);
  /// Cancels everything, the request to show a series included.
  void cancel();
  bool isBusy() const { return open_.isBusy() || load_.isBusy(); }
  /// Returns whether something is being opened, or loaded to be shown.
  bool isOpening() const { return open_.isBusy() || isLoading(); }
  /// Returns whether a series is being loaded to be shown.
  bool isLoading() const { return loading() != nullptr; }
  /// Returns the series being loaded to be shown, or null.
  std::shared_ptr<const Series> loading() const {
    return loading_ && loading_->reason != NeededFor::later ? loading_->series : nullptr;
  }

 Q_SIGNALS:
  /// Something is being opened to replace what is shown, or in an empty window.
  void openBegan();
  /// loading() changed. The session has the last one in memory unless that was not loaded.
  void loadingChanged();
  /// `study` is the study after withPictureStacks(), here and in filesOpened().
  void studyOpened(const QString& path, const std::shared_ptr<const volumen::Study>& study,
                   const volumen::OpenIntent& intent);
  void filesOpened(const QString& name, const std::shared_ptr<const volumen::Study>& study,
                   const volumen::OpenIntent& intent);
  void sessionOpened(const QString& path, const volumen::OpenedSession& session);
  void located(const volumen::Located& located);
  /// The series of a request was read: show it.
  void requestLoaded(const volumen::LoadedSeriesPtr& series, const std::optional<volumen::Scene>& scene);
  /// The load failed or the user cancelled it.
  void notLoaded(const volumen::SeriesKey& series);
  void presetReady(const QString& name, const volumen::Scene& scene, const volumen::VolumePtr& volume);
  /// A sentence; not sent for cancelled work.
  void failed(const QString& sentence);
  /// No request is left.
  void idle();

 private:
  template <class Tell>
  auto orFailed(Tell tell);
  void update();
  std::optional<NeededSeries> next();
  void begin(const Series& series);
  void take(const Result<LoadedSeriesPtr>& shown);
  void end(const QString& whyNot);
  void tellLoading();

  // A series that was not loaded.
  struct Failure {
    SeriesKey series;
    QElapsedTimer since;  // invalid: the user cancelled it
  };

  Session& session_;
  const MakeScene makeScene_;
  std::optional<NeededSeries> loading_;
  std::shared_ptr<const Series> told_;  // loading() when loadingChanged() was sent last
  int loadJob_ = 0;
  bool isTaking_ = false;  // while receivers are told of the end of a load
  std::vector<Failure> failures_;
  std::map<QString, int> joining_;  // jobs by the name of what joins the list
  JobLane open_, load_;
};

}  // namespace volumen
