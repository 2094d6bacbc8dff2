#pragma once

#include "ui/controller/segment_jobs.h"
#include "ui/workspace/segment_cut.h"

namespace volumen {

/// Why a cut cannot be made, a sentence; empty: it can.
QString whyNotCut(const Session& session, const SegmentCut& cut);
/// The work that makes it: of the current segment, recorded as the step "scissors". In a slice voxels within
/// so many mm of its plane are cut. It fails where that takes nothing away. Only without whyNotCut().
SegmentWork workOf(const SegmentCut& cut, double withinMm, const Session& session);

}  // namespace volumen
