#pragma once

#include <optional>

#include "viewer/volume/volume.h"

namespace volumen {

/// The window that was chosen for what flat views show.
struct ChosenWindow {
  std::optional<Window> window;  ///< a negative width is inverted; none: the series' own
  int namedGrey = 0;             ///< of frames without such a window: which of the file's own
  bool operator==(const ChosenWindow&) const = default;
};

}  // namespace volumen
