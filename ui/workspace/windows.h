#pragma once

#include <QString>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "results/series/loaded_series.h"
#include "ui/workspace/own_windows.h"
#include "ui/workspace/window_keys.h"
#include "ui/workspace/workspace.h"
#include "viewer/slice/grey.h"

namespace volumen {

/// Windows of projections map values to values. A negative width is an inverted window (picture.md 6).

/// Returns the scene's window, or the default if it has none.
Window windowInUse(const Scene& scene, const LoadedSeries& series);

/// Returns the window of flat views: the one that was set, else 0 to 7 SUVbw for PET with known SUV, else the
/// series' own. Defaults are inverted for PET.
Window flatWindow(const SeriesState& state, const LoadedSeries& series);
/// Returns flatWindow() of a series that is not loaded and has no window set. `ofFile` is the first window of
/// its files. Empty if its values must be known.
std::optional<Window> windowToCome(const Series& series, const std::optional<Window>& ofFile);
/// Returns the window of an overlaid series: the same, but never inverted.
Window overlayWindow(const SeriesState& state, const LoadedSeries& series);
/// Returns the SeriesState::window that gives a series this window as an overlay. It is inverted if the
/// series by itself is.
Window windowOfOverlay(const Window& over, const SeriesState& state, const LoadedSeries& series);
/// Returns the grey mapping of a flat view's window.
GreyMapping greyMapping(const Window& window, const LoadedSeries& series);

/// A window to choose by name.
struct NamedWindow {
  QString name;                  ///< "Bone (2000 / 400)"
  std::optional<Window> window;  ///< empty: automatic
  QString word{};                ///< "Bone": shown in the corner while it holds; empty: nothing
  WindowKey key{};               ///< in a list of windowChoices()
};

/// Returns the choices: automatic, the file's own, tissues for HU, from 0 upwards for SUV, then the user's
/// own.
std::vector<NamedWindow> windowChoices(const LoadedSeries& series, const OwnWindows& own = {});

/// Returns windows of tissues for HU, and from 0 to 5, 7, 10 and 15 for SUV, inverted for PET; else none.
std::vector<NamedWindow> tissueWindows(const Series& series);

/// Returns the user's own windows for a series, inverted for PET.
std::vector<NamedWindow> ownWindowsFor(const OwnWindows& own, const Series& series);

/// Returns the numbers of a window, after the name of its tissue or the user's name for it: "Bone  W 2000 L
/// 400".
QString namedWindow(const Window& window, const Series& series, const OwnWindows& own = {});

/// Returns the scene in another mode. A projection of HU without a window gets the usual one of its mode.
Scene withMode(Scene scene, Mode mode, const LoadedSeries& series);

/// Returns the scene of a built-in preset for a series. PET with known SUV is projected with the first window
/// of its planes, so that one grey is one uptake in all views.
Scene withUptakeWindow(Scene scene, const Series& series);

/// The darkest and the brightest value of a window; dark > bright if it is inverted.
struct WindowEnds {
  double dark, bright;
};
WindowEnds endsOf(const Window& window);
/// Returns the window between two different values.
Window windowBetween(WindowEnds ends);

/// Returns the smallest width that a drag makes.
double narrowestWindow(const LoadedSeries& series);

/// Returns P1 to P99 of these values, so that a speck of metal or a dead pixel does not decide. It is
/// inverted if `before` is, and at least narrowestWindow() wide. Empty if all values are NaN or there are
/// none.
std::optional<Window> windowOfValues(std::vector<float> values, const Window& before,
                                     const LoadedSeries& series);

/// Returns the window after a drag by `pixels`, right (wider) and down (higher values). A pixel is 1/80 of
/// the width at the press, but at least 1/4000 of the series' spread of values. For PET the lower end stays.
Window draggedWindow(const Window& atPress, glm::dvec2 pixels, const LoadedSeries& series);

}  // namespace volumen
