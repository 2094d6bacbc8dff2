#pragma once

#include <QWidget>
#include <optional>

#include "ui/widgets/axes.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/histogram.h"

namespace volumen {

/// Edits the opacity and colour curve over a histogram with logarithmic counts. A drag moves a point (Shift:
/// along one axis), a double-click adds one, Delete or a right-click removes it. Arrows nudge the selected
/// point (Shift: fine), Tab goes to the next one. The wheel zooms the value axis at the cursor, dragging
/// empty ground pans it, Home shows all values. A value range with two draggable ends may be shown over it.
class CurveEditor : public QWidget {
  Q_OBJECT
 public:
  explicit CurveEditor(QWidget* parent = nullptr);

  void setCurve(const TransferFunction& curve);
  const TransferFunction& curve() const { return curve_; }
  /// Sets the histogram and the unit of its values ("HU", or empty), and shows the whole range.
  void setHistogram(const Histogram& histogram, const QString& unit);
  void setOpacityScale(OpacityScale scale);
  /// In window mode the curve is the window of a projection: brightness over value between two ends, which
  /// move only along the value axis.
  void setWindow(bool window);
  OpacityScale opacityScale() const { return window_ ? OpacityScale::linear : scale_; }
  /// Returns the name of the vertical axis.
  QString axisName() const;

  /// Sets the value range over the curve; empty: none.
  void setRange(const std::optional<ValueRange>& range);
  const std::optional<ValueRange>& range() const { return range_; }
  /// Returns the handle of the lower (0) or upper (1) end.
  QRectF rangeHandle(int end) const;

  /// Returns the index of the selected point; -1: none.
  int selected() const { return selected_; }
  void select(int n);

  /// Returns the position of a point in pixels.
  QPointF positionOf(int n) const;
  /// Returns the rectangle of a point's colour swatch.
  QRectF swatchOf(int n) const;
  ValueAxis valueAxis() const;
  OpacityAxis opacityAxis() const;
  /// Sets the values in view.
  void showValues(double low, double high);
  /// Shows the whole range of the histogram.
  void showAllValues();

  QSize sizeHint() const override { return {340, 250}; }
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  /// The user changed the curve; `what` names the undo step ("Move curve point").
  void edited(const volumen::TransferFunction& curve, const QString& what);
  /// All changes since the last signal form one undo step.
  void gestureFinished();
  void selectionChanged(int n);
  /// The user drags an end of the range; `ended` is true at release.
  void rangeDragged(const volumen::ValueRange& range, bool ended);
  /// The user clicked the swatch of this point.
  void colourRequested(int n);

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;
  void mouseDoubleClickEvent(QMouseEvent*) override;
  void wheelEvent(QWheelEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  void keyReleaseEvent(QKeyEvent*) override;
  bool event(QEvent*) override;

 private:
  enum class Drag { none, point, rangeEnd, pan };

  QFont smallFont() const;
  QRectF plotRect() const;
  int pointAt(QPointF position) const;
  int swatchAt(QPointF position) const;
  int rangeEndAt(QPointF position) const;
  double endOfRange(int end) const { return end == 0 ? range_->low : range_->high; }
  void dragPointTo(QPointF position, Qt::KeyboardModifiers modifiers);
  void dragRangeTo(double pixel);
  double snapped(double value) const;
  QString moveText() const;
  void removePoint(int n);
  void nudge(double pixelsRight, double pixelsUp);
  void change(TransferFunction curve, const QString& what);

  void paintHistogram(QPainter&) const;
  void paintGrid(QPainter&) const;
  void paintTissues(QPainter&) const;
  void paintCurve(QPainter&) const;
  void paintRamp(QPainter&) const;
  void paintRange(QPainter&) const;

  TransferFunction curve_;
  Histogram histogram_;
  QString unit_;
  OpacityScale scale_ = OpacityScale::linear;
  bool window_ = false;
  double low_ = 0, high_ = 1;  // values in view
  std::optional<ValueRange> range_;
  int selected_ = -1;

  Drag drag_ = Drag::none;
  QPointF pressedAt_, pointAtPress_;
  int draggedEnd_ = 0;  // of the range
  double endAtPress_ = 0;
  ValueAxis axisAtPress_;
};

}  // namespace volumen
