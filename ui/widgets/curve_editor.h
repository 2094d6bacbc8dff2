#pragma once

#include <QWidget>
#include <optional>

#include "ui/widgets/axes.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/histogram.h"

namespace volumen {

/// The opacity and colour curve over the histogram in logarithmic counts. Drag moves a point (Shift: along
/// one axis), double-click adds one, Delete or right-click removes it, arrows nudge (Shift: fine), Tab walks
/// the points, the wheel zooms the value axis at the cursor, dragging empty ground pans it, Home shows all of
/// it. A range of values may stand over it, whose two ends are dragged.
class CurveEditor : public QWidget {
  Q_OBJECT
 public:
  explicit CurveEditor(QWidget* parent = nullptr);

  void setCurve(const TransferFunction& curve);
  const TransferFunction& curve() const { return curve_; }
  /// The histogram to draw, and the unit of its values ("HU", or empty). Shows the whole range.
  void setHistogram(const Histogram& histogram, const QString& unit);
  void setOpacityScale(OpacityScale scale);
  /// Whether the curve is the window of a projection: brightness over value between two ends, which move
  /// along the value axis only.
  void setWindow(bool window);
  OpacityScale opacityScale() const { return window_ ? OpacityScale::linear : scale_; }
  /// What the vertical axis shows.
  QString axisName() const;

  /// The range that stands over the curve; none: there is none.
  void setRange(const std::optional<ValueRange>& range);
  const std::optional<ValueRange>& range() const { return range_; }
  /// Where the handle of its lower end (0) or upper one (1) is drawn.
  QRectF rangeHandle(int end) const;

  /// Index of the selected point, -1 where none.
  int selected() const { return selected_; }
  void select(int n);

  /// Where a point is drawn.
  QPointF positionOf(int n) const;
  /// Where its colour swatch is drawn.
  QRectF swatchOf(int n) const;
  ValueAxis valueAxis() const;
  OpacityAxis opacityAxis() const;
  /// Chooses the values in view.
  void showValues(double low, double high);
  /// The histogram's whole range.
  void showAllValues();

  QSize sizeHint() const override { return {340, 250}; }
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  /// The user changed the curve; `what` names the step ("Move curve point").
  void edited(const volumen::TransferFunction& curve, const QString& what);
  /// What was changed since the last time is one step.
  void gestureFinished();
  void selectionChanged(int n);
  /// The user drags an end of the range; `ended`: the button is up.
  void rangeDragged(const volumen::ValueRange& range, bool ended);
  /// The swatch of this point was clicked.
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
