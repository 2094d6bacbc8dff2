#pragma once

#include "ui/controller/segment_jobs.h"

namespace volumen {

/// Makes what some work would come to, to be looked at before it is a step: the latest that was asked for.
class SegmentPreview : public QObject {
  Q_OBJECT
 public:
  SegmentPreview(Session& session, Jobs& jobs, QObject* parent = nullptr);

  /// Makes it of the segments as they are, in place of what was asked for before, which stays on screen until
  /// then. The work makes all. Ends in changed() or failed().
  void show(const SegmentWork& work);
  /// Nothing is looked at any more.
  void clear();
  /// The same work; what is looked at need not be made again where the segments are still those that it was
  /// made of. It must come of that work.
  SegmentWork withMade(SegmentWork work) const;

 Q_SIGNALS:
  /// What there would be, of which those are visible that are others then; none: nothing is looked at.
  void changed(const std::optional<volumen::SegmentMap>& segments);
  /// A sentence; empty where the user cancelled it. Nothing is looked at.
  void failed(const QString& sentence);

 private:
  struct Made {
    SegmentMap base, made, shown;  // of what it was made, what it is, and what of it is to be seen
  };
  void fail(const QString& sentence);

  Session& session_;
  std::optional<Made> made_;  // what is looked at
  bool isLate_ = false;       // something else was asked for since
  JobLane lane_;
};

}  // namespace volumen
