#pragma once

#include "tests/ui/segment_window.h"
#include "ui/widgets/curve_editor.h"
#include "ui/workspace/curve_spans.h"

namespace volumen::tests {

/// Returns the hollow balls as a CT, or as a PET in which 1000 Bq/ml are 5 SUVbw.
inline LoadedSeriesPtr ballsOf(bool pet) {
  auto series = std::make_shared<LoadedSeries>(*hollowBalls());
  if (!pet) return series;
  series->series.modality = "PT";
  series->series.unit = "Bq/ml";
  series->series.suv.bodyWeight = 0.005;
  series->series.suv.why = "test";
  return series;
}

/// A window with the hollow balls. The curve is above the page "From the curve".
struct AxisWindow : SegmentWindow {
  explicit AxisWindow(const LoadedSeriesPtr& series = hollowBalls()) : SegmentWindow(series) {
    child<QDockWidget>("transferDock")->raise();
    click("segmentFromCurve");
    QCoreApplication::processEvents();
    curve()->showValues(-100, 1300);
    QCoreApplication::processEvents();
  }

  CurveEditor* curve() { return child<CurveEditor>("curveEditor"); }
  QDoubleSpinBox* field(int end) { return child<QDoubleSpinBox>(end == 0 ? "segmentLow" : "segmentHigh"); }
  /// Types the ends of the range, in the unit of the fields.
  void setFields(double low, double high) {
    field(0)->setValue(low);
    field(1)->setValue(high);
  }
  QPointF flag(int end) { return curve()->rangeHandle(end).center(); }
  double pixel() { return curve()->valueAxis().valuesPerPixel(); }
  QPointF flagAt(int end, double value) {
    return flag(end) +
           QPointF(curve()->valueAxis().pixelOf(value) - curve()->valueAxis().pixelOf(ends(end)), 0);
  }
  double ends(int end) { return end == 0 ? curve()->range()->low : curve()->range()->high; }
  void dragEnd(int end, double value) { tests::drag(curve(), flag(end), flagAt(end, value)); }
  /// Sets a curve that shows what lies above `value`.
  void setFoot(double value) {
    session().edit(QStringLiteral("test"), [&](Scene& s) {
      s.transferFunction.points = {{float(value), {1, 1, 1}, 0.0}, {1200, {1, 1, 1}, 1.0}};
    });
    session().endGesture();
  }
  /// Returns the pixel at which control point `n` would be drawn if it had this value.
  QPointF pointAt(int n, double value) {
    return {curve()->valueAxis().pixelOf(value), curve()->positionOf(n).y()};
  }
  void pull(int n, double value) {
    child<QDockWidget>("transferDock")->raise();
    QCoreApplication::processEvents();
    tests::drag(curve(), curve()->positionOf(n), pointAt(n, value));
  }
  /// Makes a segment of what a curve with this foot shows, and binds it to the curve.
  bool makeBound(double foot) {
    setFoot(foot);
    return press("segment") && press("segmentFollows") && current().span == CurveSpan{0, 1};
  }
  std::optional<ValueRange> visible() {
    return rangeOfSpan(session().scene().transferFunction, 0, *session().series());
  }
};

}  // namespace volumen::tests
