#pragma once

#include "results/pictures/overlays.h"
#include "results/series/loaded_series.h"

namespace volumen {

/// Returns the overlays of a series seen by a camera: patient and series, and, if calibrated, the view's
/// name, the patient's sides at the edges and the scale. `size` is in pixels.
Overlays viewOverlays(const LoadedSeries& series, const Camera& camera, glm::dvec2 size);

/// Returns a patient position as text: "L 12.0, P 3.5, S 100.2 mm".
QString placeText(glm::dvec3 pPatient);
/// Returns a position in a series; "x 12.0, y 3.5, z 100.2 mm" if sides are unknown.
QString placeText(const Series& series, glm::dvec3 p);

}  // namespace volumen
