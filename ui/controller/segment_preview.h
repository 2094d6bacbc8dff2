#pragma once

#include "ui/controller/segment_jobs.h"

namespace volumen {

/// Previews the result of some work before it becomes an undo step; only the latest request counts.
class SegmentPreview : public QObject {
  Q_OBJECT
 public:
  SegmentPreview(Session& session, Jobs& jobs, QObject* parent = nullptr);

  /// Makes a preview from the current segments, which replaces the one before when it is ready. The work must
  /// have makeAll. Ends in changed() or failed().
  void show(const SegmentWork& work);
  /// Ends the preview.
  void clear();
  /// Returns `work` such that it reuses the preview if the segments have not changed since. The preview must
  /// come from that work.
  SegmentWork withMade(SegmentWork work) const;

 Q_SIGNALS:
  /// The previewed segments, of which only those that differ are visible; nothing if there is no preview.
  void changed(const std::optional<volumen::SegmentMap>& segments);
  /// A sentence, or empty if the user cancelled. There is no preview then.
  void failed(const QString& sentence);

 private:
  struct Made {
    SegmentMap base, made, shown;  // the source, the result, and the visible part of it
  };
  void fail(const QString& sentence);

  Session& session_;
  std::optional<Made> made_;  // the preview shown
  bool isLate_ = false;       // whether something else was requested since
  JobLane lane_;
};

}  // namespace volumen
