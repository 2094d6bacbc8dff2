#pragma once

#include <string>

#include "io/study/derived_object.h"
#include "ui/workspace/shared_map.h"

namespace volumen {

/// How flat views show the regions of a structure set or the segments of a segmentation.
struct RegionsLook {
  DerivedKind kind = DerivedKind::contours;  ///< or segmentation
  std::string label;
  std::string frameOfReferenceUid;  ///< for segmentations: only views in this frame of reference show it
  double opacity = 0.4;             ///< for segments
  SharedMap<int, bool> shown;       ///< by number; missing numbers are shown
  bool operator==(const RegionsLook&) const = default;

  bool shows(int number) const {
    const auto known = shown.find(number);
    return known == shown.end() || known->second;
  }
};

}  // namespace volumen
