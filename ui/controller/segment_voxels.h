#pragma once

#include <string>

#include "ui/controller/step_work.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Use of a connected component: one of the range is added to the segment; one of the segment is kept alone
/// or removed.
enum class PartUse { add, keep, remove };

/// A clicked point, and the use of the component there.
struct PartWanted {
  VolumePtr volume;
  Mask mask;
  ValueRange range;
  glm::dvec3 pPatient;  ///< mm
  bool onSurface;       ///< whether the nearest voxel within two voxels counts
  PartUse use;
  double leakGuardMm = 0;            ///< connections thinner than twice this are cut
  std::string neighbours = "faces";  ///< which voxels touch, a word of the step "connected"
};

/// Returns the steps for segment `number`. The Error says why there is no component.
Result<StepsWanted> stepsOfPart(const PartWanted& wanted, const SegmentMap& map, int number,
                                const CancelToken& cancel);

}  // namespace volumen
