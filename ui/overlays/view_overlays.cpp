#include "ui/overlays/view_overlays.h"

#include "results/text/series_text.h"
#include "results/text/text.h"
#include "ui/workspace/camera_moves.h"
#include "ui/workspace/corner_text.h"

namespace volumen {

namespace {

// Returns "Anterior view" or "From anterior-right".
QString sideText(const Camera& camera) {
  const std::string name = viewName(camera);
  return name.empty() ? tr("From %1").arg(QString::fromStdString(sideWords(-cameraAxes(camera).direction)))
                      : viewText(QString::fromStdString(name));
}

}  // namespace

Overlays viewOverlays(const LoadedSeries& series, const Camera& camera, glm::dvec2 size) {
  Overlays o;
  o.topLeft = seriesCorner(series.series).left();
  if (!series.volume->geometry().calibrated) return o;
  const CameraAxes axes = cameraAxes(camera);
  const auto letters = [known = knowsSides(series.series)](glm::dvec3 d) {
    return known ? QString::fromStdString(sideLetters(d)) : QString();
  };
  if (knowsSides(series.series)) o.topRight << sideText(camera);
  o.right = letters(axes.right);
  o.left = letters(-axes.right);
  o.top = letters(axes.up);
  o.bottom = letters(-axes.up);
  if (camera.projection == Projection::parallel) o.mmPerPixel = camera.height / size.y;
  return o;
}

QString placeText(const Series& series, glm::dvec3 p) {
  if (knowsSides(series)) return placeText(p);
  return QStringLiteral("x %1, y %2, z %3 mm").arg(p.x, 0, 'f', 1).arg(p.y, 0, 'f', 1).arg(p.z, 0, 'f', 1);
}

QString placeText(glm::dvec3 pPatient) {
  const auto side = [](double mm, const char* plus, const char* minus) {
    return QStringLiteral("%1 %2")
        .arg(QLatin1String(mm <= -0.05 ? minus : plus))
        .arg(std::abs(mm), 0, 'f', 1);
  };
  return QStringLiteral("%1, %2, %3 mm")
      .arg(side(pPatient.x, "L", "R"), side(pPatient.y, "P", "A"), side(pPatient.z, "S", "I"));
}

}  // namespace volumen
