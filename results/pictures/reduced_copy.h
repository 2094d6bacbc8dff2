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
  Warning warning;  ///< states needed and available memory
};

/// Makes the largest reduced copy from which the plan can be drawn in the available memory. The caller frees
/// `letGo` bytes once the copy exists. Returns nothing if the volume itself can be drawn, and an Error with
/// needed and available memory if no copy can. `name` is the name of the volume.
Result<std::optional<ReducedCopy>> copyToDraw(const Plan& plan, const Volume& volume,
                                              const VolumeFacts& facts, const std::string& name,
                                              std::uint64_t letGo = 0);

}  // namespace volumen
