#pragma once

#include <vector>

#include "ui/document/jobs.h"
#include "ui/workspace/segment_map.h"
#include "ui/workspace/segment_report.h"

namespace volumen {

/// Returns the voxelReports() of all segments, map after map.
Result<std::vector<SegmentReport>> voxelReportsOf(const std::vector<SegmentMap>& maps, const Volume& volume,
                                                  const CancelToken& cancel);

/// Returns the reports with surface measures added (addSurfaces()). The job reports which segment is
/// measured.
Result<std::vector<SegmentReport>> withSurfaces(std::vector<SegmentReport> all,
                                                const std::vector<SegmentMap>& maps, const Volume& volume,
                                                bool withPeaks, const Job& job);

}  // namespace volumen
