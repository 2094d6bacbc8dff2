#pragma once

#include <optional>

#include "io/study/warning.h"
#include "viewer/plan/plan.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// A smaller copy of a volume that is drawn in its place.
struct ReducedCopy {
  VolumePtr volume;
  int factor = 1;
  Warning warning;  ///< tells both figures
};

/// Makes the largest copy that a plan can be drawn of in the memory that there is, `letGo` more once it is
/// made. Nothing if the volume itself can be drawn; an Error with both figures if no copy can. `name`: of the
/// volume.
Result<std::optional<ReducedCopy>> copyToDraw(const Plan& plan, const Volume& volume,
                                              const VolumeFacts& facts, const std::string& name,
                                              std::uint64_t letGo = 0);

}  // namespace volumen
