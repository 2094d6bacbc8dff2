#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QToolButton>
#include <QWidget>

#include "ui/controller/segment_jobs.h"
#include "ui/controller/segment_painter.h"

namespace volumen {

/// What paints the current segment in slices: the tools, their brush, where they may paint; and what fills
/// the slices between painted ones.
class SegmentPaintPage : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentPaintPage(Session& session, QWidget* parent = nullptr);

  /// Shows what the current segment allows.
  void showSegments();
  /// The tools that paint.
  void setToolActions(QAction* brush, QAction* outline);
  /// Whether strokes erase without Ctrl.
  bool erases() const { return erases_->isChecked(); }
  /// What is chosen; `range`: the one of the page "From the curve".
  PaintLimits limits(const ValueRange& range) const;

 Q_SIGNALS:
  void workWanted(const volumen::SegmentWork& work);

 private:
  void makeLayout();
  void connectFields();
  void showBrush();
  void showOthers();
  void fillBetween();

  Session& session_;
  QToolButton *brush_, *outline_;
  QCheckBox* erases_;
  QComboBox* shape_;
  QDoubleSpinBox* mm_;
  QCheckBox* inRange_;
  QComboBox *beside_, *other_;
  QToolButton* fill_;
};

}  // namespace volumen
