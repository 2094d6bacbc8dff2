#pragma once

#include "ui/data/loaded_frame.h"
#include "ui/workspace/windows.h"

namespace volumen {

/// Whether each frame of a series has the window of its own file, and not all that of the middle one.
bool hasOwnWindows(const SeriesState& state, const Series& series);

/// How a frame is turned into grey: by the window that was set, LINEAR for integers of DICOM, else by the one
/// of the file's windows and VOI LUTs that was chosen.
GreyMapping frameGrey(const SeriesState& state, const FlatLook& look, const LoadedFrame& frame);

/// A way from value to grey to choose by name.
struct GreyChoice {
  QString name;                  ///< "SOFTER, LUT", "Bone (2000 / 400)"
  int namedGrey = 0;             ///< which of the file's
  std::optional<Window> window;  ///< in place of them
  WindowKey key{};
};

/// The first of the file's, then all of these by name, then those of tissues where values are HU, and last
/// the user's own. Empty for colour.
std::vector<GreyChoice> greyChoices(const LoadedFrame& frame, const SeriesState& state = {},
                                    const OwnWindows& own = {});

/// The state after a choice.
SeriesState withGrey(SeriesState state, const GreyChoice& choice);

/// "W 900 L 2653", and what is no straight line said behind it: "sigmoid", "LUT SOFTER".
QString greyText(const SeriesState& state, const FlatLook& look, const LoadedFrame& frame,
                 const OwnWindows& own = {});

}  // namespace volumen
