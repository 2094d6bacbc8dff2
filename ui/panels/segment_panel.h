#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>

#include "ui/controller/slice_image.h"
#include "ui/workspace/session.h"
#include "viewer/segment/label_statistics.h"

namespace volumen {

/// Segments what is visible: the value range of a span of the curve, or a typed one, becomes a segment of the
/// workspace whose voxels and millilitres are shown, that can be looked at alone, and saved.
class SegmentPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentPanel(Session& session, QWidget* parent = nullptr);

  /// Shows the segment that the series in view has.
  void showSegment();
  /// What measureRequested() came to.
  void showMeasured(const std::shared_ptr<const LabelMap>& labels, const LabelStatistics& statistics);
  /// Puts a switchable action on top.
  void setTableAction(QAction* action);

 Q_SIGNALS:
  /// Of the whole volume of the series, but what the mask takes away.
  void segmentRequested(const volumen::SeriesKey& series, const volumen::VolumePtr& volume,
                        const volumen::Mask& mask, const volumen::Segment& segment);
  void measureRequested(const std::shared_ptr<const volumen::LabelMap>& labels, int number,
                        const volumen::VolumePtr& volume);
  void saveRequested(const volumen::SegmentMap& map, const QString& path);
  /// What of which volume is looked at alone; none: all is shown.
  void previewChanged(const std::optional<volumen::VolumeRange>& segment);

 private:
  void makeLayout();
  void showSpans();
  void showInOtherUnit();
  void tellPreview();
  void showResult();
  void takeSpan(int n);
  ValueRange range() const;
  Segment segmentOf(const ValueRange& range) const;
  bool isCurved() const;
  const SegmentMap* map() const;
  VolumePtr wholeVolume() const;
  void showOnly(bool on);
  void askWhere();

  Session& session_;
  QCheckBox* table_;
  QComboBox* spans_;
  QDoubleSpinBox *low_, *high_;
  QPushButton *segment_, *save_;
  QLabel* result_;
  QCheckBox* only_;
  double factor_ = 1;                       // from values to the numbers in the fields
  std::shared_ptr<const LabelMap> labels_;  // that are shown
  VolumePtr volume_;                        // that they are of
  std::optional<LabelStatistics> statistics_;
  TransferFunction before_, alone_;  // the curve without and with "show only"
};

}  // namespace volumen
