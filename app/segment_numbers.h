#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "viewer/segment/numbers.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/result.h"

namespace volumen {

/// What is told of one segment.
struct SegmentReport {
  Segment segment;
  std::int64_t voxels = 0;            ///< of its mask, padding included
  std::optional<double> millilitres;  ///< of them; none: not calibrated
  SegmentValues values;
  std::optional<SegmentForm> form;  ///< none: no voxels, or the series is not calibrated
  std::optional<double> peak;       ///< the largest mean of a ball of 1 ml about one of its voxels
};

/// Of all segments of a volume. The Error: cancelled.
Result<std::vector<SegmentReport>> numbersOf(const Segmented& segments, const Volume& volume,
                                             const CancelToken& cancel = {});

/// One object a segment (resources/docs/segment.md); what there is none of is null.
nlohmann::ordered_json segmentsJson(const std::vector<SegmentReport>& all);
/// Columns for people.
std::string segmentsText(const std::vector<SegmentReport>& all, const std::string& unit);

}  // namespace volumen
