#pragma once

#include "viewer/volume/cancel.h"
#include "viewer/volume/rigid.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The rigid motion from the patient space of `fixed` to that of `moving` (mm) that makes the two agree best
/// by mutual information, whatever their modalities (D. Mattes et al., 2003; ITK's). Seconds; on one thread,
/// and the same to the last digit on every run. `cancel` hears how far it is.
///
/// An Error where there is nothing to be found: a volume that is not calibrated, is too small or holds one
/// value only, or where the two do not overlap in the end; or where it was cancelled. The sentence does not
/// name the volumes but as "the first" (`fixed`) and "the second".
Result<Rigid> registerRigidly(const Volume& fixed, const Volume& moving, const CancelToken& cancel = {});

}  // namespace volumen
