#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// A series laid out along one of its curves in both ways (CurvedKind).
struct CurvedPair {
  Series straightened, stretched;
};

/// The series of a curve that was measured, so far to each side of it, mm. `towards`: the normal of the plane
/// that it was drawn on, for a curve that lies on a line. What is stretched across the patient begins on the
/// patient's right, and so does what is straightened beside it. An Error says why it cannot be laid out: that
/// of curvedSeries(), the curve lies on a frame, or its series is missing.
Result<CurvedPair> curvedPair(const Workspace& workspace, const Measurement& curve, glm::dvec3 towards,
                              double halfWidth);

/// `towards` of a curve where no slices are seen that say it: as it was laid out before, else the normal of
/// its series as acquired.
glm::dvec3 usualTowards(const Workspace& workspace, const Measurement& curve);

/// What is laid out along curves of a series and has nothing made on it.
std::vector<SeriesKey> unusedCurvesOf(const Workspace& workspace, const SeriesKey& source);

/// With four views: of the series of the curve its slices as they are seen in `focus` (else as acquired), the
/// straightened plane, the stretched plane and the cross-sections. What was laid out along the curve before
/// gives way, unless something was measured on it.
Workspace withCurvedPlanes(Workspace workspace, const CurvedPair& pair);

/// The curve that is meant: the one with handles, else the last one on the series in focus; null: none.
const Measurement* curveMeant(const Workspace& workspace);

}  // namespace volumen
