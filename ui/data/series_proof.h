#pragma once

#include <string>

#include "io/study.h"

namespace volumen {

/// What tells whether a series is the one it was.
struct SeriesProof {
  VoxelGeometry geometry;  ///< of the slices as acquired
  std::string valueType;
  int files = 0;  ///< how many it is made of
  std::string
      instances;  ///< SHA-256 of their SOP Instance UIDs, in hexadecimal digits; empty: they have none
  bool operator==(const SeriesProof&) const = default;
};

SeriesProof proofOf(const Series& series);

/// What is different, for a sentence: "it has 120 slices instead of 118"; empty where nothing is.
std::string changeText(const SeriesProof& before, const SeriesProof& now);

}  // namespace volumen
