#include "viewer/segment/segment.h"

#include <string_view>

namespace volumen {

void markEdited(Segment& segment) {
  constexpr std::string_view edited = ", edited";
  segment.algorithms.clear();
  if (segment.algorithmType == SegmentAlgorithm::automatic)
    segment.algorithmType = SegmentAlgorithm::semiautomatic;
  if (segment.algorithmType == SegmentAlgorithm::semiautomatic && !segment.algorithm.empty() &&
      !segment.algorithm.ends_with(edited))
    segment.algorithm += edited;
}

}  // namespace volumen
