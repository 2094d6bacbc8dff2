#pragma once

#include <QLabel>
#include <cmath>

#include "tests/fixtures/small_volumes.h"
#include "tests/ui/measure_window.h"
#include "ui/workspace/camera_moves.h"

namespace volumen::tests {

inline constexpr double ballRadius = 12;  // mm, centred on the origin
// Largest distance of the picture's surface from the ball, mm. Linear interpolation between voxels of 1 mm
// shifts it by at most h^2 / (4 R) = 0.02 mm. Half of the opacity is reached ln 2 / 13.9 = 0.05 mm inside.
// Lines that meet the surface at a slant are allowed twice that.
inline constexpr double offTheBall = 0.15;

// Returns values that fall by 100 per mm from the centre, 500 at the ball's surface, all opaque.
inline LoadedSeriesPtr opaqueBall() {
  auto series = std::make_shared<LoadedSeries>(*ballSeries(2, 1));
  series->volume = volumeOf<float>({40, 40, 40}, glm::dmat3(1), [](glm::dvec3 p) {
    return 500 + 100 * (ballRadius - glm::length(p - 19.5));
  });
  series->firstScene.transferFunction.points = {{500, {1, 1, 1}, 0.0}, {500, {1, 1, 1}, 1.0}};
  return series;
}

struct SurfaceWindow : MeasureWindow {
  explicit SurfaceWindow(const LoadedSeriesPtr& series = opaqueBall()) : MeasureWindow(series) {
    session().setFocus(sceneViewId);
  }

  VolumeView* scene() { return window.view(); }
  glm::dvec2 sceneSize() { return {double(scene()->width()), double(scene()->height())}; }
  // Returns the pixel at which a patient position is seen.
  QPointF pixelOf(glm::dvec3 p) {
    const glm::dvec2 at = seenAt(scene()->camera(), sceneSize(), p);
    return QPointF(at.x, at.y).toPoint();
  }
  // Returns the first intersection of a pixel's line of sight with the ball.
  glm::dvec3 onBall(QPointF p) {
    const SightLine line = sightLine(scene()->camera(), sceneSize(), {p.x(), p.y()});
    const double b = glm::dot(line.origin, line.direction),
                 c = glm::dot(line.origin, line.origin) - ballRadius * ballRadius;
    return line.origin + (-b - std::sqrt(b * b - c)) * line.direction;
  }
  void click(QPointF p, Qt::KeyboardModifiers keys = {}) {
    QTest::mouseClick(scene(), Qt::LeftButton, keys, p.toPoint());
  }
  void drawLength(QPointF from, QPointF to) {
    choose(ShapeKind::length);
    drag(scene(), from, to);
  }
  // Returns what is drawn of the last measurement; without lines if nothing is.
  DrawnMeasurement seenLast() {
    for (const DrawnMeasurement& d : scene()->drawnMeasurements())
      if (d.id == last().id) return d;
    return {};
  }
  QString told() { return child<QLabel>("toldText")->text(); }
  // Reduces opacity to a tenth, so that half of the light is absorbed in ln 2 / 0.105 = 6.6 mm.
  void makeFog() {
    session().edit(QStringLiteral("fog"), [](Scene& s) {
      for (CurvePoint& p : s.transferFunction.points) p.opacity *= 0.1;
    });
  }
  bool isMeasuring() { return window.views()->tool().measuring; }
};

inline bool areNear(glm::dvec3 a, glm::dvec3 b) { return glm::length(a - b) < offTheBall; }

}  // namespace volumen::tests
