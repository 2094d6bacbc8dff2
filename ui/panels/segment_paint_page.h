#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QToolButton>
#include <QWidget>

#include "ui/controller/segment_jobs.h"
#include "ui/controller/segment_painter.h"

namespace volumen {

/// What paints the current segment in slices: the tools, their brush, where they may paint; what cuts it, and
/// what fills the slices between painted ones.
class SegmentPaintPage : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentPaintPage(Session& session, QWidget* parent = nullptr);

  /// Shows what the current segment allows.
  void showSegments();
  /// The tools that paint, and the one that cuts.
  void setToolActions(QAction* brush, QAction* outline, QAction* cut);
  /// How far on either side of a slice is cut, mm; all slices: infinity.
  double cutWithinMm() const;
  /// Whether strokes erase without Ctrl.
  bool erases() const { return erases_->isChecked(); }
  /// What is chosen; `range`: the one of the page "From the curve".
  PaintLimits limits(const ValueRange& range) const;

 Q_SIGNALS:
  void workWanted(const volumen::SegmentWork& work);

 private:
  void makeLayout();
  QHBoxLayout* lastRow();
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
  QToolButton* cut_;
  QDoubleSpinBox* cutMm_;
  QToolButton* fill_;
};

}  // namespace volumen
