#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>
#include <QToolButton>
#include <optional>

#include "ui/controller/segment_jobs.h"
#include "ui/tools/tool.h"

namespace volumen {

/// What makes segments of little: of a sphere about a lesion, of the level under the pointer, of seeds in
/// several segments.
class SegmentGrowPage : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentGrowPage(Session& session, QWidget* parent = nullptr);

  /// Shows what the segments allow; they, or the series, may be others.
  void showSegments();
  /// The tool that draws spheres, the one that traces levels, the smart brush.
  void setToolActions(QAction* lesion, QAction* trace, QAction* smart);
  /// A sphere that is drawn: the lesion in it is previewed, and a segment once it is done.
  void takeBall(const DrawnBall& ball);
  /// What previewWanted() came to instead: a sentence, empty where the user cancelled it.
  void previewFailed(const QString& sentence);

 Q_SIGNALS:
  void workWanted(const volumen::SegmentWork& work);
  /// The same; the preview may be of it.
  void growthWanted(const volumen::SegmentWork& work);
  void previewWanted(const volumen::SegmentWork& work);
  void previewEnded();
  /// A sentence.
  void refused(const QString& sentence);

 private:
  void makeLayout();
  bool isInFrameOf(const SeriesKey& shown, const Series& series) const;
  QString whyNoLesion(const DrawnBall& ball) const;
  QString whyNotGrown() const;
  SegmentWork lesionWork(const DrawnBall& ball) const;
  SegmentWork growthWork() const;
  void grow();
  void showGrowth();

  Session& session_;
  QToolButton *lesion_, *trace_, *smart_;
  QComboBox *threshold_, *region_;
  QPushButton* grow_;
  QCheckBox* preview_;
  std::optional<SegmentMap> seeds_;  // of which growth is previewed
  bool isHeld_ = false;              // what is previewed stays until the segments are others
};

}  // namespace volumen
