#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QToolButton>
#include <optional>
#include <string>

#include "ui/controller/segment_jobs.h"
#include "ui/controller/segment_voxels.h"
#include "ui/controller/slice_image.h"

namespace volumen {

/// Makes segments from a value range: a visible span of the curve, typed numbers, or ends dragged on the axis
/// of the curve. Slices tint the range meanwhile.
class SegmentRange : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentRange(Session& session, QWidget* parent = nullptr);

  /// Updates the page for the current segment.
  void showSegments();
  /// Adds a checkable action at the top.
  void setTableAction(QAction* action);
  /// Sets the tool that takes connected components.
  void setPartAction(QAction* action);
  /// Puts a range dragged on the axis of the curve into the fields.
  void takeDragged(const ValueRange& dragged);
  /// Returns the range in the fields, in stored values.
  ValueRange range() const;
  /// Returns the use of a connected component: as chosen, but Ctrl keeps only it and Alt removes it.
  PartUse partUse(Qt::KeyboardModifiers keys) const;
  /// Returns the leak guard of connected components, mm (PartWanted).
  double leakGuardMm() const { return guard_->value(); }
  /// Returns the neighbourhood of connected components (PartWanted).
  std::string partNeighbours() const { return neighbours_->currentText().toStdString(); }
  /// Returns a segment of these values, named after them.
  Segment segmentOf(const ValueRange& range) const;

 Q_SIGNALS:
  void workWanted(const volumen::SegmentWork& work);
  /// The previewed range of a volume changed; empty ends the preview.
  void previewChanged(const std::optional<volumen::VolumeRange>& range);
  /// The axis of the curve is to show this range; empty if the page is hidden or there is no series.
  void rangeShown(const std::optional<volumen::ValueRange>& range);

 protected:
  void showEvent(QShowEvent*) override { showOnAxis(); }
  void hideEvent(QHideEvent*) override { showOnAxis(); }

 private:
  void makeLayout();
  void connectFields();
  void showSpans();
  void showInOtherUnit();
  void showOnAxis();
  void tellPreview();
  void setPreviewing(bool on);
  void takeSpan(int n);
  void make();
  void replace();
  void bind(bool on);
  void replaceBy(const QString& text, const std::optional<CurveSpan>& span);
  SegmentWork workOf(const ValueRange& range) const;
  const Segment* ranged() const;
  void showOnly(bool on);

  Session& session_;
  QCheckBox* table_;
  QComboBox* spans_;
  QDoubleSpinBox *low_, *high_;
  QPushButton *make_, *replace_;
  QCheckBox *follows_, *only_;
  QToolButton* part_;
  QComboBox* use_;
  QDoubleSpinBox* guard_;
  QComboBox* neighbours_;
  SeriesKey offeredFor_;             // the series of the fields
  double factor_ = 1;                // from values to numbers in the fields
  bool isPreviewing_ = false;        // true while the typed range is previewed
  ValueRange aloneRange_;            // the range of "show only"
  TransferFunction before_, alone_;  // the curve without and with "show only"
};

}  // namespace volumen
