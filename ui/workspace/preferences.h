#pragma once

#include <map>
#include <string>

#include "io/study/suv.h"
#include "ui/workspace/own_windows.h"

namespace volumen {

enum class Theme { dark, light };

/// What paints segments in slices: a disc in the slice, or a ball.
struct Brush {
  static constexpr double leastMm = 1, mostMm = 200;  ///< of diameterMm
  bool ball = false;
  double diameterMm = 10;  ///< in the patient
  bool operator==(const Brush&) const = default;
};

/// How one person wants the window; kept from one start to the next.
struct Preferences {
  Theme theme = Theme::dark;
  int textPercent = 100;                             ///< of the system's text size
  std::string mousePreset = "volumen";               ///< one of mousePresets() (ui/tools/mouse_bindings)
  std::map<std::string, std::string> mouseBindings;  ///< in place of its rows: {"flat.right", "pan"}
  bool zoomDragInverted = false;                     ///< dragging down enlarges
  bool wheelInverted = false;                        ///< the wheel towards the hand enlarges
  bool curveDragInverted = false;                    ///< dragging up shifts the curve to higher values
  bool logarithmicOpacity = false;
  bool crosshairLines = true;  ///< of planes of one series, in each other
  bool referenceLines = true;  ///< of planes of other views
  bool referenceEnds = false;  ///< and of their first and last slices
  bool hideNames = false;
  bool tableIn3d = false;                    ///< of CT
  PetUnit petUnit = PetUnit::suvBodyWeight;  ///< where it can be had
  int memoryPercent = 25;                    ///< of the machine's memory, for series that are not on screen
  Brush brush;
  OwnWindows windows;  ///< of flat views and projections, by name
  bool operator==(const Preferences&) const = default;
};

/// The defaults, with what the user made himself of these.
Preferences defaultsFor(const Preferences& preferences);

/// Those kept by storePreferences(); the defaults for what was never kept or cannot be read.
Preferences storedPreferences();
void storePreferences(const Preferences& preferences);

}  // namespace volumen
