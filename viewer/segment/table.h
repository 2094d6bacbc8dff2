#pragma once

#include <functional>

#include "viewer/segment/label_map.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// What is above this is no air, lung or foam, HU.
inline constexpr double notAirHu = -300;

/// Label 1: the patient in a CT, without the table. The largest connected part of what is above notAirHu,
/// with all that it encloses in its slice (lungs, bowel) and grown by about 3 mm, so that the skin keeps its
/// edge. Empty where nothing is above notAirHu. Values must be HU.
LabelMap patientMask(const Volume& volume, const CancelToken& cancel = {});

/// A copy of a CT with air (-1000 HU, or the nearest value that there is) outside patientMask(), which its
/// attributes say. The Error: it was cancelled, there is no patient in it, or too little memory.
Result<VolumePtr> withoutTable(const Volume& volume, const CancelToken& cancel = {});

}  // namespace volumen
