#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>
#include <QToolButton>
#include <optional>

#include "ui/controller/segment_jobs.h"
#include "ui/tools/tool.h"

namespace volumen {

/// Makes segments from small input: a sphere around a lesion, a contour at the level under the pointer, or
/// seeds in several segments.
class SegmentGrowPage : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentGrowPage(Session& session, QWidget* parent = nullptr);

  /// Updates the page for the present segments and series.
  void showSegments();
  /// Sets the tools that draw spheres, trace levels and paint with the smart brush.
  void setToolActions(QAction* lesion, QAction* trace, QAction* smart);
  /// Takes a sphere. Previews its lesion while it is being drawn, and makes a segment at the end.
  void takeBall(const DrawnBall& ball);
  /// Reports that a requested preview failed. `sentence` is empty if the user cancelled it.
  void previewFailed(const QString& sentence);

 Q_SIGNALS:
  void workWanted(const volumen::SegmentWork& work);
  /// Requests growth like workWanted(). The preview may already hold the result.
  void growthWanted(const volumen::SegmentWork& work);
  void previewWanted(const volumen::SegmentWork& work);
  void previewEnded();
  /// `sentence` is the reason.
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
  std::optional<SegmentMap> seeds_;  // seeds whose growth is being previewed
  bool isHeld_ = false;              // keeps the preview until the segments change
};

}  // namespace volumen
