#pragma once

#include "ui/controller/segment_jobs.h"
#include "ui/workspace/segment_options.h"

namespace volumen {

/// Edits the segments of the series that the Segments panel shows. Tools get it with the press, panels hold
/// it. Holds what is chosen for editing, and what slices preview. All requests are answered in one way.
class SegmentEditing : public QObject {
  Q_OBJECT
 public:
  SegmentEditing(Session& session, Jobs& jobs);

  Session& session() { return session_; }
  const SegmentOptions& options() const { return options_; }
  void choose(const std::function<void(SegmentOptions&)>& change);

  /// Paints the next part of a stroke into the current segment, as chosen at its start.
  void paint(SegmentStroke stroke);
  /// Paints a whole stroke.
  void paintAll(SegmentStroke stroke);
  /// Requests a change (SegmentJobs::change). A preview of it stays until it is an undo step. An Error is
  /// answered as a refusal.
  void change(const Result<SegmentWork>& work);
  /// Previews a change while a tool is used, in place of growth from seeds. The work must have makeAll. An
  /// Error or a failure ends the preview without an answer.
  void preview(const Result<SegmentWork>& work);
  /// Ends that preview.
  void endPreview();
  /// Grows the segments from the seeds. A preview is used if nothing has changed since.
  void grow();
  /// Answers with a sentence about a result that should not be missed.
  void note(const QString& sentence) { Q_EMIT answered({SegmentAnswer::Kind::noted, sentence}); }

  /// Returns the previewed segments, of which only those that would change are visible. Null if there is no
  /// preview.
  const SegmentMap* previewed() const { return made_ ? &made_->shown : nullptr; }
  const SegmentPainter& painter() const { return painter_; }
  SegmentJobs& jobs() { return jobs_; }

 Q_SIGNALS:
  void answered(const volumen::SegmentAnswer& answer);
  void optionsChanged();
  void previewChanged();

 private:
  // A result before it is an undo step: its source, and the part of it that slices show.
  struct Made {
    SegmentMap base, made, shown;
  };
  void follow();
  void showGrowth();
  void stopGrowthPreview();
  void show(const SegmentWork& work);
  void fail(const QString& sentence);
  void clear();

  Session& session_;
  SegmentOptions options_;
  SegmentPainter painter_;
  SegmentJobs jobs_;
  std::optional<Made> made_;         // what is previewed
  bool isLate_ = false;              // whether something else was to be previewed since
  std::optional<SegmentMap> seeds_;  // seeds whose growth is previewed
  bool isOfTool_ = false;            // whether a tool previews something
  bool isHeld_ = false;              // keeps the preview until the segments change
  JobLane preview_;
};

}  // namespace volumen
