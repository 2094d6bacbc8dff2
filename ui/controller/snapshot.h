#pragma once

#include <QElapsedTimer>
#include <QTimer>

#include "ui/controller/draw_service.h"
#include "ui/data/loaded_series.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/snapshot_request.h"
#include "viewer/plan/picture_text.h"

namespace volumen {

/// Takes snapshots one after another, each as a job. The render thread draws them, another thread writes
/// them. Each request ends in saved(), copied() or failed().
class Snapshot : public QObject {
  Q_OBJECT
 public:
  Snapshot(DrawService& drawService, Jobs& jobs, QObject* parent = nullptr);
  ~Snapshot() override;

  /// Sets the source of the measured error of exactly the picture of a plan; it is written with the picture.
  void setMeasured(std::function<std::optional<MeasuredError>(const Plan&)> measured) {
    measured_ = std::move(measured);
  }
  /// Takes a snapshot of the requested content, whatever is on screen when it is drawn.
  void take(const SnapshotRequest& request);

 Q_SIGNALS:
  /// `path` is the last one if there are several pictures.
  void saved(const QString& path, int pictures);
  void copied();
  void failed(const QString& sentence);

 private:
  struct Shot {
    SnapshotRequest request;
    Job job;
    int drawn = 0;    // number of its pictures drawn
    double part = 0;  // reported last
    QElapsedTimer clock;
  };

  void begin();
  void draw();
  void cancel(int job);
  void tellProgress();
  void write(const std::shared_ptr<Drawn>& drawn);
  void written(const QImage& forClipboard, const QString& path, const QString& failure);
  void end(const QString& failure);

  DrawService& drawService_;
  Jobs& jobs_;
  std::deque<Shot> shots_;  // the first is in progress
  int number_ = 0;          // of the requested picture
  QTimer tick_;
  std::function<std::optional<MeasuredError>(const Plan&)> measured_;
  JobLane writing_;
};

/// Returns "head-007.png" for "head.png" and 7.
QString numberedPath(const QString& path, int number);

}  // namespace volumen
