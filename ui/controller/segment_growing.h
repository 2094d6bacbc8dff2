#pragma once

#include "ui/controller/segment_jobs.h"
#include "viewer/segment/lesion.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// The region to grow in: the box of the seeds with a margin, or everything.
enum class GrowthRegion { aboutSeeds, everywhere };

/// Returns whether a segment is a seed: it is visible and not locked.
bool isSeed(const Segment& segment);

/// Returns the work that assigns all voxels of a region to the seeds (grow_from_seeds.h), with the step
/// "growFromSeeds". Hidden and locked segments and masked voxels stay unchanged. The margin of `aboutSeeds`
/// is marginAboutSeeds().
SegmentWork growthOf(const SeriesKey& series, VolumePtr volume, const Mask& mask, GrowthRegion region);

/// A sphere in the patient in which a lesion is searched.
struct LesionWanted {
  VolumePtr volume;  ///< the whole volume
  Mask mask;         ///< masked voxels are not in the sphere
  glm::dvec3 pPatient;
  double radiusMm;
  LesionThreshold threshold;
  QString said{};                    ///< description of the segment
  std::vector<SegmentMap> beside{};  ///< other maps of the series; their segments' names are taken
};

/// Returns the work that adds a segment for the lesion in a sphere (lesion.h). Its name is "Lesion 1", or has
/// the next free number of the series.
SegmentWork lesionOf(const SeriesKey& series, const LesionWanted& wanted);

}  // namespace volumen
