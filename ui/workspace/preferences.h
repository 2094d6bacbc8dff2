#pragma once

#include "io/study/suv.h"
#include "ui/workspace/own_windows.h"

namespace volumen {

enum class Theme { dark, light };

/// What dragging with a mouse button does in the view.
enum class DragAction { rotate, pan, zoom, curve };

/// The name of its tool (ui/tools), and in settings.
const char* nameOf(DragAction action);

/// How one person wants the window; kept from one start to the next.
struct Preferences {
  Theme theme = Theme::dark;
  int textPercent = 100;  ///< of the system's text size
  /// A left drag is the chosen tool's.
  DragAction middleDrag = DragAction::pan, rightDrag = DragAction::zoom, shiftDrag = DragAction::pan;
  bool zoomDragInverted = false;   ///< dragging down enlarges
  bool wheelInverted = false;      ///< the wheel towards the hand enlarges
  bool curveDragInverted = false;  ///< dragging up shifts the curve to higher values
  bool logarithmicOpacity = false;
  bool hideNames = false;
  PetUnit petUnit = PetUnit::suvBodyWeight;  ///< where it can be had
  int memoryPercent = 25;                    ///< of the machine's memory, for series that are not on screen
  OwnWindows windows;                        ///< of flat views and projections, by name
  bool operator==(const Preferences&) const = default;
};

/// The defaults, with what the user made himself of these.
Preferences defaultsFor(const Preferences& preferences);

/// Those kept by storePreferences(); the defaults for what was never kept or cannot be read.
Preferences storedPreferences();
void storePreferences(const Preferences& preferences);

}  // namespace volumen
