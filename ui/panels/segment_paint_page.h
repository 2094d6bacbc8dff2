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

/// Paints the current segment in slices: tools, brush and limits. Also cuts it and fills slices between
/// painted ones.
class SegmentPaintPage : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentPaintPage(Session& session, QWidget* parent = nullptr);

  /// Updates the page for the current segment.
  void showSegments();
  /// Sets the painting tools and the cutting tool.
  void setToolActions(QAction* brush, QAction* outline, QAction* cut);
  /// Returns how far the cut reaches on either side of a slice, mm; infinity for all slices.
  double cutWithinMm() const;
  /// Returns whether strokes erase without Ctrl.
  bool erases() const { return erases_->isChecked(); }
  /// Returns the chosen limits. `range` is the one of the page "From the curve".
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
