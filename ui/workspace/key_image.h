#pragma once

#include <string>

#include "ui/data/series_key.h"

namespace volumen {

/// A picture that the user marked.
struct KeyImage {
  SeriesKey series;
  std::string sopInstanceUid;
  int frame = 0;  ///< of that instance, from 0
  bool operator==(const KeyImage&) const = default;
};

}  // namespace volumen
