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

/// A series of its own whose voxels are these.
inline LoadedSeriesPtr seriesOf(VolumePtr volume) {
  auto series = std::make_shared<LoadedSeries>(*ballSeries(2, 1));
  series->volume = std::move(volume);
  return series;
}

/// Where each kind is drawn, pixels of the view.
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

/// All that a tool draws and then gives way to the one before; the arrow last, which asks for its text.
inline const std::vector<ShapeKind> drawnKinds{
    ShapeKind::length,    ShapeKind::polyline, ShapeKind::bidirectional,  ShapeKind::angle,
    ShapeKind::cobb,      ShapeKind::legAxis,  ShapeKind::cardiothoracic, ShapeKind::ellipse,
    ShapeKind::rectangle, ShapeKind::freehand, ShapeKind::probe,          ShapeKind::arrow};

/// As radiologists draw it: lines and boxes by drags, the rest of an angle and of a polyline by clicks. The
/// tool is in hand.
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

/// A window that shows a series in planes, and what a hand measures in them.
struct MeasureWindow : Journey {
  explicit MeasureWindow(const LoadedSeriesPtr& series = ballSeries(32, 10, {3, -2, 4})) {
    session().show(series);
    child<QAction>("layoutPlanes")->trigger();
    QCoreApplication::processEvents();
    session().setFocus(axialViewId);  // as a press would: it is no step
  }

  /// With what is opened, as it hangs.
  explicit MeasureWindow(const QStringList& paths) : Journey(paths) {}

  Session& session() { return window.session(); }
  FlatView* view(ViewId id = axialViewId) { return window.views()->viewAs<FlatView>(id); }
  const SharedList<Measurement>& all() { return session().workspace().measurements; }
  const Measurement& last() { return all().back(); }
  glm::dvec3 patient(QPointF p, ViewId id = axialViewId) {
    return view(id)->plane()->patientFromPixel({p.x(), p.y()});
  }
  /// These places moved and enlarged, so that the longer side of their box is twice `mm`, its middle there in
  /// the patient: they lie in the volume however large views are.
  std::vector<QPointF> placesWithin(std::vector<QPointF> places, glm::dvec3 pMiddle, double mm,
                                    ViewId id = axialViewId) {
    const SlicePlane plane = *view(id)->plane();
    const QRectF box = QPolygonF(QList<QPointF>(places.begin(), places.end())).boundingRect();
    const glm::dvec2 middle = plane.pixelFromPatient(pMiddle);
    const double larger = 2 * mm / plane.mmPerPixel / std::max(box.width(), box.height());
    for (QPointF& p : places)
      p = (QPointF(middle.x, middle.y) + larger * (p - box.center())).toPoint();  // as the mouse is
    return places;
  }
  void choose(ShapeKind kind) {
    child<QAction>((std::string(ruleOf(kind).name) + "Tool").c_str())->trigger();
  }

  /// drawShape() with its tool.
  void draw(ShapeKind kind, const std::vector<QPointF>& p, ViewId id = axialViewId,
            Qt::KeyboardModifiers keys = {}) {
    choose(kind);
    drawShape(view(id), kind, p, keys);
  }

  /// What is seen of a measurement in a view; without lines where nothing is.
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
