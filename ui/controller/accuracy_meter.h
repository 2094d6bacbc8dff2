#pragma once

#include "ui/controller/draw_service.h"
#include "ui/controller/measured_levels.h"
#include "ui/document/job_lane.h"

namespace volumen {

/// Measures the time and the error against the reference of each quality level of the picture on screen. The
/// reference is computed at some pixels on a thread of its own; idle time of the render thread draws the
/// levels. A change of the scene cancels the measurement.
class AccuracyMeter : public QObject {
  Q_OBJECT
 public:
  explicit AccuracyMeter(DrawService& drawService, QObject* parent = nullptr);

  /// Sets the picture at rest on screen; `complete` is a complete scene (a plan's). The measurement starts
  /// once it is wanted.
  void show(VolumePtr volume, const Scene& complete, QSize pixels);
  /// Cancels the measurement and discards its results, because the picture changes.
  void forget();
  /// Sets whether the figures are on screen.
  void setWatched(bool watched);
  /// Sets whether a level is to be chosen by the figures.
  void setNeeded(bool needed);

  const MeasuredLevels& measured() const { return measured_; }
  bool running() const { return running_; }

 Q_SIGNALS:
  /// measured() has new results, or they were discarded.
  void changed();
  /// `what` is in progress while running; `share` is 0 to 1.
  void progressed(const QString& what, double share);
  /// Everything is measured.
  void finished();
  /// The measurement was cancelled before everything was measured.
  void cancelled();

 private:
  struct Shown {
    VolumePtr volume;
    Scene scene;
    QSize pixels;
    bool operator==(const Shown&) const = default;
  };

  bool wanted() const { return watched_ || needed_; }
  void startOrStop();
  void start();
  void stop();
  void computeTruth();
  void takeTruth(std::shared_ptr<const Truth> truth);
  void drawNext();
  void take(const Trial& trial);
  void describe(MeasuredLevel& level, const Trial& trial) const;

  DrawService& drawService_;
  std::optional<Shown> shown_;
  MeasuredLevels measured_;
  bool watched_ = false, needed_ = false, running_ = false;
  std::size_t next_ = 0;          // index of the level
  std::vector<double> framesMs_;  // of that level
  int awaited_ = 0;               // number of the trial
  JobLane lane_;
};

}  // namespace volumen
