#pragma once

#include <QElapsedTimer>
#include <QTimer>

#include "ui/controller/draw_service.h"
#include "ui/data/loaded_series.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/snapshot_request.h"
#include "viewer/plan/picture_text.h"

namespace volumen {

/// Takes snapshots, one after the other, each a job: drawn by the render thread, written by another. Each
/// that is asked for ends in saved(), copied() or failed().
class Snapshot : public QObject {
  Q_OBJECT
 public:
  Snapshot(DrawService& drawService, Jobs& jobs, QObject* parent = nullptr);
  ~Snapshot() override;

  /// Where to ask what was measured of exactly the picture that a plan draws: written with it.
  void setMeasured(std::function<std::optional<MeasuredError>(const Plan&)> measured) {
    measured_ = std::move(measured);
  }
  /// Of what was seen then, whatever is on show when it is drawn.
  void take(const SnapshotRequest& request);

 Q_SIGNALS:
  /// Of several pictures: the last one's path.
  void saved(const QString& path, int pictures);
  void copied();
  void failed(const QString& sentence);

 private:
  struct Shot {
    SnapshotRequest request;
    Job job;
    int drawn = 0;    // pictures of it
    double part = 0;  // told last
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
  std::deque<Shot> shots_;  // the first is under way
  int number_ = 0;          // of the picture asked for
  QTimer tick_;
  std::function<std::optional<MeasuredError>(const Plan&)> measured_;
  JobLane writing_;
};

/// "head.png" and 7 -> "head-007.png".
QString numberedPath(const QString& path, int number);

}  // namespace volumen
