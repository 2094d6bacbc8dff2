#pragma once

#include <optional>

#include "viewer/volume/volume.h"

namespace volumen {

/// The window chosen for flat views.
struct ChosenWindow {
  std::optional<Window> window;  ///< negative width: inverted; empty: the series' own window
  int namedGrey = 0;             ///< index among the file's own windows, for frames without `window`
  bool operator==(const ChosenWindow&) const = default;
};

}  // namespace volumen
