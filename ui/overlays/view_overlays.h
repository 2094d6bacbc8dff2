#pragma once

#include "ui/data/loaded_series.h"
#include "ui/overlays/overlays.h"

namespace volumen {

/// What holds of a series seen by a camera in any picture of it: patient and series, and, where they are
/// known, the view's name, the patient's sides at the edges and the scale. `size` in pixels.
Overlays viewOverlays(const LoadedSeries& series, const Camera& camera, glm::dvec2 size);

/// "L 12.0, P 3.5, S 100.2 mm": a patient position.
QString placeText(glm::dvec3 pPatient);
/// The same in a series: "x 12.0, y 3.5, z 100.2 mm" where sides are not known.
QString placeText(const Series& series, glm::dvec3 p);

}  // namespace volumen
