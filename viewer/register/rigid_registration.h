#pragma once

#include "viewer/volume/cancel.h"
#include "viewer/volume/rigid.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Returns the rigid motion from the patient space of `fixed` to that of `moving` (mm) with the largest
/// mutual information, for any modalities (D. Mattes et al., 2003; ITK's). Takes seconds on one thread; every
/// run gives the same digits. `cancel` is told the progress.
/// The Error means: a volume is not calibrated, too small or constant, the two do not overlap in the end, or
/// cancelled. Its sentence calls the volumes "the first" (`fixed`) and "the second".
Result<Rigid> registerRigidly(const Volume& fixed, const Volume& moving, const CancelToken& cancel = {});

}  // namespace volumen
