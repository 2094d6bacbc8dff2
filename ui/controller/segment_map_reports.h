#pragma once

#include <vector>

#include "ui/document/jobs.h"
#include "ui/workspace/segment_map.h"
#include "ui/workspace/segment_report.h"

namespace volumen {

/// The voxelReports() of all segments of maps, map after map.
Result<std::vector<SegmentReport>> voxelReportsOf(const std::vector<SegmentMap>& maps, const Volume& volume,
                                                  const CancelToken& cancel);

/// The same with what takes surfaces (addSurfaces()); the job tells which segment is measured.
Result<std::vector<SegmentReport>> withSurfaces(std::vector<SegmentReport> all,
                                                const std::vector<SegmentMap>& maps, const Volume& volume,
                                                bool withPeaks, const Job& job);

}  // namespace volumen
