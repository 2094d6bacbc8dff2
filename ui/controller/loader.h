#pragma once

#include <QObject>
#include <QThreadPool>
#include <atomic>
#include <functional>
#include <memory>

#include "io/study.h"
#include "ui/controller/locate.h"
#include "ui/controller/open_intent.h"
#include "ui/controller/open_session.h"
#include "ui/data/shown_series.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The scene of a named preset for a volume ("auto" chooses).
using MakeScene = std::function<Result<Scene>(const std::string& preset, const Volume& volume)>;

/// Opens paths, loads series and makes presets on a worker thread, one after the other, and tells the results
/// on its own thread.
class Loader : public QObject {
  Q_OBJECT
 public:
  explicit Loader(MakeScene makeScene, QObject* parent = nullptr);
  /// Gives up what is under way.
  ~Loader() override;

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
  void makePreset(const QString& name, VolumePtr volume);
  void cancel();
  bool isBusy() const { return underWay_ > 0; }
  /// Gives up the load that is under way alone.
  void cancelLoad();

 Q_SIGNALS:
  void studyOpened(const QString& path, const std::shared_ptr<const volumen::Study>& study,
                   const volumen::OpenIntent& intent);
  void filesOpened(const QString& name, const std::shared_ptr<const volumen::Study>& study,
                   const volumen::OpenIntent& intent);
  void sessionOpened(const QString& path, const volumen::OpenedSession& session);
  void located(const volumen::Located& located);
  void seriesLoaded(const volumen::ShownSeriesPtr& series, const std::optional<volumen::Scene>& scene);
  void loadedAhead(const volumen::ShownSeriesPtr& series);
  /// It failed or was cancelled; not for what another series took the place of.
  void notLoaded(const volumen::SeriesKey& series);
  void presetReady(const QString& name, const volumen::Scene& scene, const volumen::VolumePtr& volume);
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);
  /// total 0: not known.
  void progressed(const QString& what, qint64 done, qint64 total);
  /// Whether anything is under way.
  void busyChanged(bool busy);

 private:
  using Job = std::function<void(const CancelToken& cancel, const Progress& progress)>;

  void start(QThreadPool& pool, const CancelToken& cancel, Job job);
  Progress progressTeller(const CancelToken& cancel);
  void begin(const Series& series, bool isAhead);
  template <class Function>
  void tell(const CancelToken& cancel, Function function);

  const MakeScene makeScene_;
  QThreadPool openPool_, loadPool_;  // one thread each: paths in order, beside what is made of the volumes
  CancelToken cancel_, loadCancel_;  // of everything else, and of the series being loaded
  int underWay_ = 0;
  std::optional<SeriesKey> loading_;
  std::optional<Scene> scene_;  // to show what is being loaded by
  bool isAhead_ = false;        // nobody waits for what is being loaded
};

}  // namespace volumen
