#pragma once

#include "results/series/loaded_frame.h"
#include "ui/workspace/windows.h"

namespace volumen {

/// Returns whether each frame uses the window of its own file instead of that of the middle frame.
bool hasOwnWindows(const SeriesState& state, const Series& series);

/// Returns the grey mapping of a frame: the window that was set (LINEAR for DICOM integers), else the chosen
/// one of the file's windows and VOI LUTs.
GreyMapping frameGrey(const SeriesState& state, const FlatLook& look, const LoadedFrame& frame);

/// A grey mapping to choose by name.
struct GreyChoice {
  QString name;                  ///< "SOFTER, LUT", "Bone (2000 / 400)"
  int namedGrey = 0;             ///< index among those of the file
  std::optional<Window> window;  ///< replaces those of the file
  WindowKey key{};
};

/// Returns the choices: automatic (the file's first), the file's by name, tissue windows if values are HU,
/// then the user's own. Empty for colour frames.
std::vector<GreyChoice> greyChoices(const LoadedFrame& frame, const SeriesState& state = {},
                                    const OwnWindows& own = {});

/// Returns the state after a choice.
SeriesState withGrey(SeriesState state, const GreyChoice& choice);

/// Returns "W 900 L 2653", followed by "sigmoid" if it is one, or "LUT SOFTER" for a table.
QString greyText(const SeriesState& state, const FlatLook& look, const LoadedFrame& frame,
                 const OwnWindows& own = {});

}  // namespace volumen
