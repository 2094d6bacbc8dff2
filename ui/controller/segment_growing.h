#pragma once

#include "ui/controller/segment_jobs.h"
#include "viewer/segment/lesion.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Where is grown from seeds: in the box about them and some more on all sides, or everywhere.
enum class GrowthRegion { aboutSeeds, everywhere };

/// Whether a segment is one of the seeds: it is shown and not locked.
bool isSeed(const Segment& segment);

/// The work that gives all voxels of a region to the seeds (grow_from_seeds.h), by the step "growFromSeeds":
/// segments that are hidden or locked and what the mask takes away stay as they are. About the seeds is
/// marginAboutSeeds().
SegmentWork growthOf(const SeriesKey& series, VolumePtr volume, const Mask& mask, GrowthRegion region);

/// A ball of the patient in which a lesion is looked for.
struct LesionWanted {
  VolumePtr volume;  ///< all of it
  Mask mask;         ///< what it takes away is not in the ball
  glm::dvec3 pPatient;
  double radiusMm;
  LesionThreshold threshold;
  QString said{};                    ///< of the segment, its description
  std::vector<SegmentMap> beside{};  ///< of the series: what their segments are called it is not
};

/// The work that adds a segment, "Lesion 1", or with the next number that is free in the series, for the
/// lesion in a ball (lesion.h).
SegmentWork lesionOf(const SeriesKey& series, const LesionWanted& wanted);

}  // namespace volumen
