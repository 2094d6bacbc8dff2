#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>

#include "ui/workspace/range_segment.h"
#include "ui/workspace/session.h"

namespace volumen {

/// RangeSegment what is visible: the value range of a span of the curve, or a typed one, becomes a label map
/// whose voxels and millilitres are shown, that can be looked at alone, and saved.
class SegmentPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentPanel(Session& session, QWidget* parent = nullptr);

  /// Shows what a request came to; null: nothing yet.
  void showSegmentation(const std::shared_ptr<const RangeSegment>& segmentation);
  /// It is in a file now.
  void noteSaved(const std::shared_ptr<const RangeSegment>& segmentation);
  /// "the segment" that is in no file; empty: there is none.
  QString unsavedText() const;
  /// Puts a switchable action on top.
  void setTableAction(QAction* action);

 Q_SIGNALS:
  void segmentRequested(const volumen::VolumePtr& volume, const volumen::ValueRange& range);
  void saveRequested(const std::shared_ptr<const volumen::RangeSegment>& segmentation,
                     const volumen::SegmentFile& file);
  /// The segment that is looked at alone; null: none is.
  void previewChanged(const std::shared_ptr<const volumen::RangeSegment>& segmentation);

 private:
  void makeLayout();
  void showSpans();
  void showInOtherUnit();
  void showResult();
  void takeSpan(int n);
  ValueRange range() const;
  void showOnly(bool on);
  void askWhere();

  Session& session_;
  QCheckBox* table_;
  QComboBox* spans_;
  QDoubleSpinBox *low_, *high_;
  QPushButton *segment_, *save_;
  QLabel *result_, *unsaved_;
  QCheckBox* only_;
  double factor_ = 1;  // from values to the numbers in the fields
  std::shared_ptr<const RangeSegment> segmentation_;
  TransferFunction before_, alone_;  // the curve without and with "show only"
};

}  // namespace volumen
