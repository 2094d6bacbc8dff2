#pragma once

#include <vector>

namespace volumen {

/// How the frames of a clip follow each other (PS3.3 C.7.6.5).
struct Cine {
  double framesPerSecond = 0;        ///< as the file recommends; 0: it does not
  std::vector<double> frameTimesMs;  ///< from the frame before to each frame; empty: always the same
  bool backAndForth = false;         ///< PreferredPlaybackSequencing 1
  bool operator==(const Cine&) const = default;
};

}  // namespace volumen
