#pragma once

#include <QWidget>
#include <optional>

#include "ui/controller/segment_editing.h"
#include "results/pictures/slice_image.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QPushButton;

namespace volumen {

/// Makes segments from a value range: a visible span of the curve, typed numbers, or ends dragged on the axis
/// of the curve. Slices tint the range meanwhile.
class SegmentRange : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentRange(SegmentEditing& editing, QWidget* parent = nullptr);

  /// Updates the page for the current segment.
  void showSegments();
  /// Adds a checkable action at the top.
  void setTableAction(QAction* action);

 Q_SIGNALS:
  /// A segment is being made of the range.
  void making();
  /// The previewed range of a volume changed; empty ends the preview.
  void previewChanged(const std::optional<volumen::VolumeRange>& range);
  /// The axis of the curve is to show this range; empty if the page is hidden or there is no series.
  void rangeShown(const std::optional<volumen::ValueRange>& range);

 protected:
  void showEvent(QShowEvent*) override { showOnAxis(); }
  void hideEvent(QHideEvent*) override { showOnAxis(); }

 private:
  void connectFields();
  void showSpans();
  ValueRange typed() const;
  void takeTyped();
  void takeRange();
  void showInOtherUnit();
  void showOnAxis();
  void tellPreview();
  void setPreviewing(bool on);
  void takeSpan(int n);
  void make();
  void replace();
  void bind(bool on);
  void replaceBy(const QString& text, const std::optional<CurveSpan>& span);
  SegmentWork workOfRange(const QString& text) const;
  const Segment* ranged() const;
  void showOnly(bool on);

  SegmentEditing& editing_;
  Session& session_;
  QCheckBox* table_;
  QComboBox* spans_;
  QDoubleSpinBox *low_, *high_;
  QPushButton *make_, *replace_;
  QCheckBox *follows_, *only_;
  SeriesKey offeredFor_;             // the series of the fields
  double factor_ = 1;                // from values to numbers in the fields
  bool isPreviewing_ = false;        // true while the typed range is previewed
  ValueRange aloneRange_;            // the range of "show only"
  TransferFunction before_, alone_;  // the curve without and with "show only"
};

}  // namespace volumen
