#pragma once

#include <functional>

#include "viewer/segment/dense_labels.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// What is above this is no air, lung or foam, HU.
inline constexpr double notAirHu = -300;

/// Label 1: the patient in a CT, without the table. The largest connected part of what is above notAirHu,
/// with all that it encloses in its slice (lungs, bowel) and grown by about 3 mm, so that the skin keeps its
/// edge. Empty where nothing is above notAirHu. Values must be HU.
DenseLabels patientMask(const Volume& volume, const CancelToken& cancel = {});

}  // namespace volumen
