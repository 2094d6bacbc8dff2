#pragma once

#include <functional>
#include <optional>

#include "ui/controller/segment_jobs.h"
#include "ui/workspace/segment_options.h"
#include "viewer/segment/mask.h"

namespace volumen {

// Work on the series that the Segments panel shows.

/// A cut from the current segment of a series, outlined in 3D or in a slice.
struct SegmentCut {
  SeriesKey series;
  Lasso lasso{};         ///< in a slice: parallel, from a point of its plane
  bool inSlice = false;  ///< in a slice, where the depth can be limited
  bool onFrame = false;  ///< on a picture that is no slice of a volume: there is no lasso
};

/// Returns the work that cuts the current segment, recorded as the step "scissors". It fails if nothing is
/// removed. The Error says why the cut cannot be made.
Result<SegmentWork> cutOf(const Session& session, const SegmentOptions& options, const SegmentCut& cut);

/// Returns the work that assigns all voxels of a region to the seeds (grow_from_seeds.h), with the step
/// "growFromSeeds". Seeds are the segments that are visible and not locked. Other segments and masked voxels
/// stay unchanged. The margin of `aboutSeeds` is marginAboutSeeds().
SegmentWork growthOf(const SeriesKey& series, VolumePtr volume, const Mask& mask, GrowthRegion region);
/// Returns the work that grows the seeds of the series in the Segments panel. The Error says why nothing can
/// be grown.
Result<SegmentWork> growthOf(const Session& session, GrowthRegion region);

/// Returns the work that moves the current segment, which must exist, into map number `map` of its series, or
/// into a new one. It takes voxels from the segments there. If so, `told` receives a sentence with their
/// number once it is an undo step.
SegmentWork moveOf(const Session& session, std::optional<int> map,
                   std::function<void(const QString& sentence)> told);

}  // namespace volumen
