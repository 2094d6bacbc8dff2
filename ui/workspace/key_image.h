#pragma once

#include <optional>
#include <string>

#include "ui/data/series_key.h"
#include "ui/workspace/chosen_window.h"

namespace volumen {

/// A picture that the user marked.
struct KeyImage {
  SeriesKey series;
  std::string sopInstanceUid;
  int frame = 0;  ///< of that instance, from 0
  /// Of the view that it was marked in, where that had one alone; none: that of its series.
  std::optional<ChosenWindow> window{};
  bool operator==(const KeyImage&) const = default;
};

}  // namespace volumen
