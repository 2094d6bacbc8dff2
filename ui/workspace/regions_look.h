#pragma once

#include <string>

#include "io/study/derived_object.h"
#include "ui/workspace/shared_map.h"

namespace volumen {

/// How flat views show the regions of a structure set or the segments of a segmentation.
struct RegionsLook {
  DerivedKind kind = DerivedKind::contours;  ///< or segmentation
  std::string label;
  std::string frameOfReferenceUid;  ///< of a segmentation; views of others do not show it
  double opacity = 0.4;             ///< of segments
  SharedMap<int, bool> shown;       ///< by number; those that are not there are shown
  bool operator==(const RegionsLook&) const = default;

  bool shows(int number) const {
    const auto known = shown.find(number);
    return known == shown.end() || known->second;
  }
};

}  // namespace volumen
