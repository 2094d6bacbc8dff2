#pragma once

#include <span>

#include "ui/controller/segment_jobs.h"
#include "viewer/segment/lesion.h"

namespace volumen {

/// A sphere in the patient in which a lesion is searched.
struct LesionBall {
  SeriesKey series;  ///< the series in whose view it is drawn
  glm::dvec3 pPatient;
  double radiusMm = 0;
  bool onFrame = false;  ///< on a frame that is not a slice of a volume
};

/// Returns the thresholds on offer: shares of the maximum, then values in SUVbw.
std::span<const LesionThreshold> lesionThresholds();
QString thresholdText(const LesionThreshold& threshold);

/// Returns the work that adds a segment for the lesion in a sphere (lesion.h) to the series of the Segments
/// panel. Its name is "Lesion 1", or has the next free number of the series. Masked voxels are not in the
/// sphere. The Error says why no lesion can be searched.
Result<SegmentWork> lesionOf(const Session& session, const LesionThreshold& threshold,
                             const LesionBall& ball);

}  // namespace volumen
