#pragma once

#include <optional>
#include <string>

#include "io/study/series_key.h"
#include "ui/workspace/chosen_window.h"

namespace volumen {

/// A picture that the user marked as key image.
struct KeyImage {
  SeriesKey series;
  std::string sopInstanceUid;
  int frame = 0;  ///< in that instance, from 0
  /// Window of the view it was marked in, if the view had its own; empty: the window of its series.
  std::optional<ChosenWindow> window{};
  bool operator==(const KeyImage&) const = default;
};

}  // namespace volumen
