#pragma once

#include <string>

#include "ui/controller/step_work.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// What becomes of a connected part: a part of the range is added to the segment, a part of the segment is
/// all that stays of it, or goes.
enum class PartUse { add, keep, remove };

/// A place that was clicked, and what is done with the part there.
struct PartWanted {
  VolumePtr volume;
  Mask mask;
  ValueRange range;
  glm::dvec3 pPatient;  ///< mm
  bool onSurface;       ///< the nearest voxel within two of it counts
  PartUse use;
  double leakGuardMm = 0;            ///< nothing goes through what is thinner than twice that
  std::string neighbours = "faces";  ///< which voxels touch, a word of the step "connected"
};

/// The steps that do that to the segment of a number. The Error says why there is no part.
Result<StepsWanted> stepsOfPart(const PartWanted& wanted, const SegmentMap& map, int number,
                                const CancelToken& cancel);

}  // namespace volumen
