#pragma once

#include <QStringList>

#include <QObject>

#include "ui/controller/segment_painter.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Updates segments bound to a span of the curve when the curve is dragged. One job at a time follows the
/// latest curve, within the undo step of the drag. If segments changed meanwhile or a stroke is being drawn,
/// the update runs again afterwards.
class CurveFollower : public QObject {
  Q_OBJECT
 public:
  CurveFollower(Session& session, const SegmentPainter& painter, Jobs& jobs, QObject* parent = nullptr);

  /// Reports that the curve of the 3D view in focus was dragged, as an undo step or a part of one.
  void follow();

 Q_SIGNALS:
  /// Updated segments took voxels from others, or the update failed. Not sent for cancelled work.
  void answered(const volumen::SegmentAnswer& answer);

 private:
  void release();
  void begin(bool overUndone);
  // The result, with sentences for the user.
  struct Made {
    Result<std::vector<SegmentMap>> maps;
    QStringList said{};
  };
  void take(const Made& made);

  Session& session_;
  const SegmentPainter& painter_;
  int step_ = -1;  // undo step in which the curve was dragged
  // Segments before the drag: voxels taken within one drag are given back.
  std::vector<SegmentMap> base_;
  std::vector<SegmentMap> made_;     // the result so far
  std::vector<SegmentMap> started_;  // segments when the job began
  TransferFunction curve_;           // the curve the job follows
  bool pulledAgain_ = false;         // whether the curve changed during the job
  bool waitsForStroke_ = false;      // whether to update once the stroke has ended
  bool overUndone_ = false;  // whether the redo steps come from a cancelled stroke and may be discarded
  JobLane lane_;
};

}  // namespace volumen
