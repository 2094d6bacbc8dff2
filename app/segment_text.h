#pragma once

#include <string>
#include <vector>

#include "io/study/suv.h"
#include "ui/workspace/segment_report.h"

namespace volumen {

/// What people look at first of segments, in columns; those of their surfaces where they were measured.
std::string segmentsText(const std::vector<SegmentReport>& all, const ValueScale& scale, bool withSurfaces);

/// Segments of two files that were compared.
struct ComparedSegments {
  std::string first, second;  ///< names
  SegmentLikeness alike;
};
std::string comparedText(const std::vector<ComparedSegments>& all);

}  // namespace volumen
