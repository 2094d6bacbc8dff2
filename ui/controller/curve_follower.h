#pragma once

#include <QStringList>

#include <QObject>

#include "ui/controller/segment_painter.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Makes segments that are bound to a span of the curve again when the curve is pulled: a job at a time, of
/// the latest curve, each in the undo step of the pull. Where segments were changed meanwhile, or a stroke is
/// being drawn, they are made again after that.
class CurveFollower : public QObject {
  Q_OBJECT
 public:
  CurveFollower(Session& session, const SegmentPainter& painter, Jobs& jobs, QObject* parent = nullptr);

  /// The curve of the 3D view in focus was just pulled, as a step or a part of one.
  void follow();

 Q_SIGNALS:
  /// What segments that followed took from others, a sentence.
  void told(const QString& sentence);
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);

 private:
  void begin(bool overUndone);
  // What they come to, with what is to be said of it.
  struct Made {
    Result<std::vector<SegmentMap>> maps;
    QStringList said;
  };
  void take(const Made& made);

  Session& session_;
  const SegmentPainter& painter_;
  int step_ = -1;                    // of the undo stack, which the curve was pulled in
  std::vector<SegmentMap> base_;     // as they were when that began: what one pull takes it gives back
  std::vector<SegmentMap> made_;     // what they came to so far
  std::vector<SegmentMap> started_;  // as they were when the job began
  TransferFunction curve_;           // that the job follows
  bool pulledAgain_ = false;         // meanwhile
  bool waitsForStroke_ = false;      // to follow once that has ended
  bool overUndone_ = false;          // what can be redone is a stroke that was given up: it may go
  JobLane lane_;
};

}  // namespace volumen
