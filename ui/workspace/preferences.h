#pragma once

#include <map>
#include <string>

#include "io/study/suv.h"
#include "ui/workspace/own_windows.h"

namespace volumen {

enum class Theme { dark, light };

/// The brush that paints segments in slices: a disc in the slice, or a ball.
struct Brush {
  static constexpr double leastMm = 1, mostMm = 200;  ///< limits of diameterMm
  bool ball = false;
  double diameterMm = 10;  ///< in patient space
  bool operator==(const Brush&) const = default;
};

/// One person's preferences, kept from one start to the next.
struct Preferences {
  Theme theme = Theme::dark;
  int textPercent = 100;                             ///< relative to the system's text size
  std::string mousePreset = "volumen";               ///< one of mousePresets() (ui/tools/mouse_bindings)
  std::map<std::string, std::string> mouseBindings;  ///< replaces its rows: {"flat.right", "pan"}
  bool zoomDragInverted = false;                     ///< dragging down enlarges
  bool wheelInverted = false;                        ///< turning the wheel towards the hand enlarges
  bool curveDragInverted = false;                    ///< dragging up shifts the curve to higher values
  bool logarithmicOpacity = false;
  bool crosshairLines = true;  ///< planes of one series, drawn in each other
  bool referenceLines = true;  ///< planes of other views
  bool referenceEnds = false;  ///< also their first and last slices
  bool hideNames = false;
  bool exportsWithoutIdentity = false;       ///< the switch of File > Export...
  bool receives = false;                     ///< listens for studies that others send
  bool tableIn3d = false;                    ///< CT only
  PetUnit petUnit = PetUnit::suvBodyWeight;  ///< if available
  int memoryPercent = 25;  ///< part of the machine's memory for series that are not on screen
  Brush brush;
  OwnWindows windows;  ///< the user's own, for flat views and projections
  bool operator==(const Preferences&) const = default;
};

/// Returns the defaults with the user's own windows.
Preferences defaultsFor(const Preferences& preferences);

/// Returns stored preferences, and defaults for those never stored or unreadable.
Preferences storedPreferences();
void storePreferences(const Preferences& preferences);

}  // namespace volumen
