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

/// Makes segments of what is visible: the value range of a span of the curve, one that is typed, or whose
/// ends are dragged on the axis of the curve. Slices tint it meanwhile.
class SegmentRange : public QWidget {
  Q_OBJECT
 public:
  explicit SegmentRange(Session& session, QWidget* parent = nullptr);

  /// Shows what the current segment allows.
  void showSegments();
  /// Puts a switchable action on top.
  void setTableAction(QAction* action);
  /// The tool that takes connected parts.
  void setPartAction(QAction* action);
  /// An end of the range was dragged on the axis of the curve: the fields follow.
  void takeDragged(const ValueRange& dragged);
  /// As it is typed.
  ValueRange range() const;
  /// What becomes of a connected part: what is chosen, but with Ctrl held it is kept alone, with Alt removed.
  PartUse partUse(Qt::KeyboardModifiers keys) const;
  /// Of connected parts, mm (PartWanted).
  double leakGuardMm() const { return guard_->value(); }
  /// Likewise, which of their voxels touch.
  std::string partNeighbours() const { return neighbours_->currentText().toStdString(); }
  /// A segment of these values, called by them.
  Segment segmentOf(const ValueRange& range) const;

 Q_SIGNALS:
  void workWanted(const volumen::SegmentWork& work);
  /// What of which volume is looked at; none: nothing.
  void previewChanged(const std::optional<volumen::VolumeRange>& range);
  /// What the axis of the curve is to show; none: nothing, the page is not seen or there is no series.
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
  SeriesKey offeredFor_;             // the series that the fields are of
  double factor_ = 1;                // from values to the numbers in the fields
  bool isPreviewing_ = false;        // the range that is being typed
  ValueRange aloneRange_;            // what "show only" shows
  TransferFunction before_, alone_;  // the curve without and with it
};

}  // namespace volumen
