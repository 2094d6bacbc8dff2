#pragma once

#include <QString>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "ui/data/loaded_series.h"
#include "ui/workspace/own_windows.h"
#include "ui/workspace/window_keys.h"
#include "ui/workspace/workspace.h"
#include "viewer/slice/grey.h"

namespace volumen {

/// Windows of projections, from value to value; a negative width is an inverted window (picture.md 6).

/// The scene's, or the one that stands for none.
Window windowInUse(const Scene& scene, const LoadedSeries& series);

/// Of flat views: the one that was set, else 0 to 7 SUVbw of PET where that is known, else the series' own;
/// inverted for PET.
Window flatWindow(const SeriesState& state, const LoadedSeries& series);
/// flatWindow() of a series that is not loaded, where nothing was set; `ofFile`: the first window of its
/// files. None: its values must be known.
std::optional<Window> windowToCome(const Series& series, const std::optional<Window>& ofFile);
/// Of a series over another: the same, never inverted.
Window overlayWindow(const SeriesState& state, const LoadedSeries& series);
/// What SeriesState::window is where a series is to have this window over another: inverted where it is by
/// itself.
Window windowOfOverlay(const Window& over, const SeriesState& state, const LoadedSeries& series);
/// The mapping from value to grey that a window of a flat view stands for.
GreyMapping greyMapping(const Window& window, const LoadedSeries& series);

/// A window to choose by name.
struct NamedWindow {
  QString name;                  ///< "Bone (2000 / 400)"
  std::optional<Window> window;  ///< none: automatic
  QString word{};                ///< "Bone": what stands in the corner while it holds; empty: nothing
  WindowKey key{};               ///< in a list of windowChoices()
};

/// Automatic, the file's own, for HU those of tissues, for SUV those from 0 on, and last the user's own.
std::vector<NamedWindow> windowChoices(const LoadedSeries& series, const OwnWindows& own = {});

/// Those of tissues, for HU; from 0 to 5, 7, 10 and 15 of SUV, inverted as PET is; else none.
std::vector<NamedWindow> tissueWindows(const Series& series);

/// Those of the user's own that are for a series; inverted where it is PET.
std::vector<NamedWindow> ownWindowsFor(const OwnWindows& own, const Series& series);

/// "Bone  W 2000 L 400": the numbers of a window, and before them the tissue that it is made for, or the
/// user's name for it.
QString namedWindow(const Window& window, const Series& series, const OwnWindows& own = {});

/// The scene drawn in another mode; a projection without a window gets one that suits its values.
Scene withMode(Scene scene, Mode mode, const LoadedSeries& series);

/// The scene of one of the program's own presets for a series: PET whose SUV is known is projected by the
/// window that its planes begin with, so that one grey is one uptake in all views.
Scene withUptakeWindow(Scene scene, const Series& series);

/// Its darkest and brightest value: low > high where it is inverted.
struct WindowEnds {
  double dark, bright;
};
WindowEnds endsOf(const Window& window);
/// The window between two different values.
Window windowBetween(WindowEnds ends);

/// The least width that a drag makes.
double narrowestWindow(const LoadedSeries& series);

/// P1 .. P99 of these values, so that a speck of metal or a dead pixel among them does not decide; inverted
/// where `before` is, and as wide at least as a drag makes it. None: there are no values (not NaN).
std::optional<Window> windowOfValues(std::vector<float> values, const Window& before,
                                     const LoadedSeries& series);

/// The window after a drag by so many pixels to the right (wider) and down (up: lower values): a pixel is
/// 1/80 of the width at the press, but not less than 1/4000 of the series' spread of values. Of PET the lower
/// end stays.
Window draggedWindow(const Window& atPress, glm::dvec2 pixels, const LoadedSeries& series);

}  // namespace volumen
