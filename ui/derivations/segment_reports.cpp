#include "ui/derivations/segment_reports.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "results/text/text.h"
#include "ui/controller/segment_painter.h"
#include "ui/controller/segment_target.h"

namespace volumen {

namespace {

using Reports = Result<SegmentReports::ValuePtr>;

Reports shared(std::vector<SegmentReport> reports) {
  return std::make_shared<const std::vector<SegmentReport>>(std::move(reports));
}

// The job reports which segment is measured.
Reports withSurfaces(std::vector<SegmentReport> all, const SegmentReportsKey& key, bool withPeaks,
                     const Job& job) {
  std::size_t first = 0;
  for (const SegmentMap& map : key.maps) {
    const auto ofMap = std::span(all).subspan(first, map.segments.size());
    const auto tell = [&](const Segment& segment, std::size_t done) {
      job.tell(tr("Measuring %1").arg(shownText(segment.label)), double(first + done) / double(all.size()));
    };
    if (const Status s = addSurfaces(ofMap, *map.labels, *key.volume, withPeaks, job.cancel(), tell); !s)
      return s.error();
    first += map.segments.size();
  }
  return shared(std::move(all));
}

// Returns whether both maps have the same voxels and segments, so that their numbers are equal.
bool holdTheSame(const SegmentMap& a, const SegmentMap& b) {
  return a.labels == b.labels &&
         std::ranges::equal(a.segments, b.segments, {}, &Segment::number, &Segment::number);
}

}  // namespace

bool SegmentReportsKey::operator==(const SegmentReportsKey& other) const {
  return volume == other.volume && withSurfaces == other.withSurfaces &&
         std::ranges::equal(maps, other.maps, holdTheSame);
}

Result<std::vector<SegmentReport>> voxelReportsOf(const SegmentReportsKey& key, const CancelToken& cancel) {
  std::vector<SegmentReport> all;
  for (const SegmentMap& map : key.maps) {
    auto reports = voxelReports(map.segments, *map.labels, *key.volume, cancel);
    if (!reports) return reports.error();
    for (SegmentReport& report : *reports) {
      report.map = map.number;
      report.made = madeText(report.segment, map.steps);
    }
    std::ranges::move(*reports, std::back_inserter(all));
  }
  return all;
}

SegmentReportsKey segmentReportsKey(const Session& session, bool withSurfaces) {
  return {copiesOf(allSegmentsShown(session)), wholeVolume(session), withSurfaces};
}

SegmentReports::Rule segmentReportsRule(const Session& session, const SegmentPainter& painter,
                                        const SegmentReports& reports, std::function<bool()> isOpen) {
  return {.wanted = [&session, isOpen]() -> std::vector<SegmentReportsKey> {
            if (!isOpen() || !segmentsShown(session)) return {};
            return {segmentReportsKey(session, false), segmentReportsKey(session, true)};
          },
          .work = [&session, &reports](const SegmentReportsKey& key, std::size_t) -> SegmentReports::Work {
            if (!key.withSurfaces)
              return [key](const Job& job) -> Reports {
                auto made = voxelReportsOf(key, job.cancel());
                return made ? shared(*std::move(made)) : made.error();
              };
            SegmentReportsKey first = key;
            first.withSurfaces = false;
            const SegmentReports::Entry voxels = *reports.find(first);
            return [key, voxels, withPeaks = hasPeaks(session.series()->series.modality)](const Job& job) {
              return voxels.value ? withSurfaces(*voxels.value, key, withPeaks, job) : Error{voxels.whyNot};
            };
          },
          .name =
              [](const SegmentReportsKey& key) {
                return JobName(key.withSurfaces ? tr("Measuring surfaces of segments")
                                                : tr("Measuring segments"));
              },
          .bytes = [](const std::vector<SegmentReport>&) { return std::size_t(0); },
          .isPaused = [&painter, isOpen] { return isOpen() && painter.isPainting(); },
          .lacksMemory = outOfMemory};
}

}  // namespace volumen
