#pragma once

#include <QPolygonF>
#include <algorithm>
#include <glm/geometric.hpp>

#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/ui/test_series.h"
#include "ui/views/drawn_measurement.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/measurement_text.h"
#include "ui/workspace/measurements.h"

namespace volumen::tests {

/// Returns the points at which each kind is drawn, pixels of the view.
inline std::vector<QPointF> placesOf(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::angle:
      return {{60, 60}, {120, 90}, {100, 150}};
    case ShapeKind::cobb:
      return {{60, 60}, {130, 70}, {60, 140}, {120, 160}};
    case ShapeKind::legAxis:
      return {{90, 50}, {110, 100}, {96, 150}};
    case ShapeKind::bidirectional:
      return {{60, 60}, {140, 60}, {100, 40}, {100, 90}};
    case ShapeKind::cardiothoracic:
      return {{80, 90}, {130, 90}, {60, 110}, {160, 110}};
    case ShapeKind::polyline:
      return {{50, 50}, {90, 60}, {110, 120}, {60, 130}};
    case ShapeKind::freehand:
      return {{60, 60}, {120, 62}, {140, 110}, {100, 150}, {58, 120}};
    case ShapeKind::probe:
      return {{101, 97}};
    default:
      return {{70, 60}, {131, 111}};
  }
}

/// All shapes whose tool gives way to the one before after drawing. The arrow is last because it asks for its
/// text.
inline const std::vector<ShapeKind> drawnKinds{
    ShapeKind::length,    ShapeKind::polyline, ShapeKind::bidirectional,  ShapeKind::angle,
    ShapeKind::cobb,      ShapeKind::legAxis,  ShapeKind::cardiothoracic, ShapeKind::ellipse,
    ShapeKind::rectangle, ShapeKind::freehand, ShapeKind::probe,          ShapeKind::arrow};

/// Draws a shape as radiologists do: lines and boxes by drags, the rest of an angle or polyline by clicks.
/// Its tool must be active.
inline void drawShape(FlatView* on, ShapeKind kind, const std::vector<QPointF>& p,
                      Qt::KeyboardModifiers keys = {}) {
  const auto click = [&](QPointF at) { QTest::mouseClick(on, Qt::LeftButton, keys, at.toPoint()); };
  if (kind == ShapeKind::freehand) {
    QTest::mousePress(on, Qt::LeftButton, keys, p[0].toPoint());
    for (const QPointF at : p) QTest::mouseEvent(QTest::MouseMove, on, Qt::LeftButton, keys, at.toPoint());
    QTest::mouseRelease(on, Qt::LeftButton, keys, p.back().toPoint());
    return;
  }
  if (kind == ShapeKind::probe || kind == ShapeKind::polyline) {
    for (const QPointF at : p) click(at);
    if (kind == ShapeKind::polyline) QTest::keyClick(on, Qt::Key_Return, keys);
    return;
  }
  drag(on, p[0], p[1], Qt::LeftButton, keys);
  if (p.size() == 3) click(p[2]);
  if (p.size() == 4) drag(on, p[2], p[3], Qt::LeftButton, keys);
}

/// A window that shows a series in planes and measures in them by mouse.
struct MeasureWindow : Journey {
  explicit MeasureWindow(const LoadedSeriesPtr& series = ballSeries(32, 10, {3, -2, 4})) {
    session().show(series);
    child<QAction>("layoutPlanes")->trigger();
    QCoreApplication::processEvents();
    session().setFocus(axialViewId);  // as a press would, which is no undo step
  }

  /// Opens files in their hanging.
  explicit MeasureWindow(const QStringList& paths) : Journey(paths) {}

  Session& session() { return window.session(); }
  FlatView* view(ViewId id = axialViewId) { return window.views()->viewAs<FlatView>(id); }
  const SharedList<Measurement>& all() { return session().workspace().measurements; }
  const Measurement& last() { return all().back(); }
  glm::dvec3 patient(QPointF p, ViewId id = axialViewId) {
    return view(id)->plane()->patientFromPixel({p.x(), p.y()});
  }
  /// Moves and scales points so that the longer side of their box is 2 `mm` and its centre is `pMiddle`. They
  /// then lie in the volume however large the views are.
  std::vector<QPointF> placesWithin(std::vector<QPointF> places, glm::dvec3 pMiddle, double mm,
                                    ViewId id = axialViewId) {
    const SlicePlane plane = *view(id)->plane();
    const QRectF box = QPolygonF(QList<QPointF>(places.begin(), places.end())).boundingRect();
    const glm::dvec2 middle = plane.pixelFromPatient(pMiddle);
    const double larger = 2 * mm / plane.mmPerPixel / std::max(box.width(), box.height());
    for (QPointF& p : places)
      // Rounds to whole pixels, like the mouse.
      p = (QPointF(middle.x, middle.y) + larger * (p - box.center())).toPoint();
    return places;
  }
  void choose(ShapeKind kind) {
    child<QAction>((std::string(ruleOf(kind).name) + "Tool").c_str())->trigger();
  }

  /// Chooses the tool, then calls drawShape().
  void draw(ShapeKind kind, const std::vector<QPointF>& p, ViewId id = axialViewId,
            Qt::KeyboardModifiers keys = {}) {
    choose(kind);
    drawShape(view(id), kind, p, keys);
  }

  /// Returns what a view draws of a measurement; without lines if it draws nothing.
  DrawnMeasurement drawn(int measurement, ViewId id = axialViewId) {
    for (const DrawnMeasurement& d : view(id)->drawnMeasurements())
      if (d.id == measurement) return d;
    return {};
  }
  Result<Measured> measured(const Measurement& m) {
    const LoadedSeriesPtr series = session().seriesNamed(m.series);
    return measure(m.shape, *series->volume, series->series.unit);
  }
  void undo() { child<QAction>("undo")->trigger(); }
  void redo() { child<QAction>("redo")->trigger(); }
};

}  // namespace volumen::tests
