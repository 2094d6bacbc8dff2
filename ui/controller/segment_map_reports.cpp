#include "ui/controller/segment_map_reports.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "ui/workspace/text.h"

namespace volumen {

Result<std::vector<SegmentReport>> voxelReportsOf(const std::vector<SegmentMap>& maps, const Volume& volume,
                                                  const CancelToken& cancel) {
  std::vector<SegmentReport> all;
  for (const SegmentMap& map : maps) {
    auto reports = voxelReports(map.segments, *map.labels, volume, cancel);
    if (!reports) return reports;
    for (SegmentReport& report : *reports) {
      report.map = map.number;
      report.made = madeText(report.segment, map.steps);
    }
    std::ranges::move(*reports, std::back_inserter(all));
  }
  return all;
}

Result<std::vector<SegmentReport>> withSurfaces(std::vector<SegmentReport> all,
                                                const std::vector<SegmentMap>& maps, const Volume& volume,
                                                bool withPeaks, const Job& job) {
  std::size_t first = 0;
  for (const SegmentMap& map : maps) {
    const auto ofMap = std::span(all).subspan(first, map.segments.size());
    const auto tell = [&](const Segment& segment, std::size_t done) {
      job.tell(tr("Measuring %1").arg(shownText(segment.label)), double(first + done) / double(all.size()));
    };
    if (const Status s = addSurfaces(ofMap, *map.labels, volume, withPeaks, job.cancel(), tell); !s)
      return s.error();
    first += map.segments.size();
  }
  return all;
}

}  // namespace volumen
