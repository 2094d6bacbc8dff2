#pragma once

#include <string>

#include "ui/controller/segment_jobs.h"
#include "ui/workspace/segment_options.h"
#include "viewer/segment/mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// A click on a connected component.
struct PartClick {
  SeriesKey series;
  glm::dvec3 pPatient;     ///< mm
  bool onSurface = false;  ///< on a surface in a 3D view, which lies between voxels
  Qt::KeyboardModifiers keys{};
  bool onFrame = false;  ///< on a frame that is not a slice of a volume
};

/// A click in a volume with a mask, and its options.
struct PartWanted {
  VolumePtr volume;
  Mask mask;
  PartClick click;         ///< on a surface, the nearest voxel within two voxels counts
  SegmentOptions options;  ///< range, use, leak guard and neighbours
};

/// Returns the steps for segment `number`. The Error says why there is no component.
Result<StepsWanted> stepsOfPart(const PartWanted& wanted, const SegmentMap& map, int number,
                                const CancelToken& cancel);

/// Returns the work that uses the clicked component as chosen, but Ctrl keeps only it and Alt removes it. The
/// first component makes a segment. The Error says why nothing can be done.
Result<SegmentWork> partOf(const Session& session, const SegmentOptions& options, const PartClick& click);

/// Returns a segment of these values, named after them.
Segment segmentOfRange(const ValueRange& range, const Series& series);

}  // namespace volumen
