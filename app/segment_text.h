#pragma once

#include <string>
#include <vector>

#include "io/study/suv.h"
#include "results/numbers/segment_report.h"

namespace volumen {

/// Returns the most important numbers of segments in columns, with those of surfaces if measured.
std::string segmentsText(const std::vector<SegmentReport>& all, const ValueScale& scale, bool withSurfaces);

/// A pair of compared segments of two files.
struct ComparedSegments {
  std::string first, second;  ///< names
  SegmentLikeness alike;
};
std::string comparedText(const std::vector<ComparedSegments>& all);

}  // namespace volumen
