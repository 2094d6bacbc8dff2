#pragma once

#include "ui/controller/segment_jobs.h"
#include "ui/workspace/segment_cut.h"

namespace volumen {

/// Returns a sentence why a cut cannot be made; empty if it can.
QString whyNotCut(const Session& session, const SegmentCut& cut);
/// Returns the work that cuts the current segment, recorded as the step "scissors". In a slice it cuts voxels
/// within `withinMm` of the plane. It fails if nothing is removed. Requires whyNotCut() to be empty.
SegmentWork workOf(const SegmentCut& cut, double withinMm, const Session& session);

}  // namespace volumen
