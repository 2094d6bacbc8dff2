#pragma once

#include <vector>

namespace volumen {

/// Timing and order in which the frames of a clip are played (PS3.3 C.7.6.5).
struct Cine {
  double framesPerSecond = 0;        ///< frame rate that the file recommends; 0 if it recommends none
  std::vector<double> frameTimesMs;  ///< time from the previous frame to each frame; empty if it is constant
  bool backAndForth = false;         ///< true if PreferredPlaybackSequencing is 1
  bool operator==(const Cine&) const = default;
};

}  // namespace volumen
