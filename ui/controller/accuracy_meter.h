#pragma once

#include "ui/controller/draw_service.h"
#include "ui/controller/measured_levels.h"
#include "ui/document/job_lane.h"

namespace volumen {

/// Measures what each level of the picture on screen takes and how far it is from the reference: the
/// reference at some pixels on a thread of its own, the levels' pictures by the render thread where that has
/// nothing else to do. Given up as soon as the scene changes.
class AccuracyMeter : public QObject {
  Q_OBJECT
 public:
  explicit AccuracyMeter(DrawService& drawService, QObject* parent = nullptr);

  /// The picture at rest now on screen: a complete scene (a plan's). Measured once it is wanted.
  void show(VolumePtr volume, const Scene& complete, QSize pixels);
  /// The picture changes: gives up, and forgets what was measured.
  void forget();
  /// Whether anybody looks at the figures.
  void setWatched(bool watched);
  /// Whether a level is to be picked by them.
  void setNeeded(bool needed);

  const MeasuredLevels& measured() const { return measured_; }
  bool running() const { return running_; }

 Q_SIGNALS:
  /// Something new in measured(), or it was forgotten.
  void changed();
  /// What is being done, while running; share 0..1.
  void progressed(const QString& what, double share);
  /// All is measured.
  void finished();
  /// Given up before all was measured.
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
  std::size_t next_ = 0;          // level
  std::vector<double> framesMs_;  // of it
  int awaited_ = 0;               // number of the trial
  JobLane lane_;
};

}  // namespace volumen
