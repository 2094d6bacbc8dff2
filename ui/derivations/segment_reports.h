#pragma once

#include <functional>
#include <vector>

#include "results/numbers/segment_report.h"
#include "results/segments/segment_map.h"
#include "ui/document/derivation.h"
#include "ui/workspace/session.h"

namespace volumen {

class SegmentPainter;

/// Inputs of the reports of all segments of a series. Names and colours do not count.
struct SegmentReportsKey {
  std::vector<SegmentMap> maps;
  VolumePtr volume;
  bool withSurfaces = false;  ///< with surface measures and peaks, which take longest
  bool operator==(const SegmentReportsKey& other) const;
};

/// Reports of segments, map after map.
using SegmentReports = Derivation<SegmentReportsKey, std::vector<SegmentReport>>;

/// Returns the inputs for the segments in the Segments panel.
SegmentReportsKey segmentReportsKey(const Session& session, bool withSurfaces);

/// Returns the reports without surfaces. The Error: cancelled, or too little memory. Slow.
Result<std::vector<SegmentReport>> voxelReportsOf(const SegmentReportsKey& key, const CancelToken& cancel);

/// Returns the rule for the reports of these segments while `isOpen`: first without surfaces, then with
/// them. Strokes are included once they end. `reports` is the derivation that follows this rule.
SegmentReports::Rule segmentReportsRule(const Session& session, const SegmentPainter& painter,
                                        const SegmentReports& reports, std::function<bool()> isOpen);

}  // namespace volumen
