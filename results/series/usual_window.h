#pragma once

#include <optional>

#include "io/study/series.h"
#include "viewer/slice/grey.h"

namespace volumen {

/// Returns 0 to 7 SUVbw as stored values for PET whose uptake is known; else nothing.
std::optional<Window> uptakeWindow(const Series& series);

/// Orients a window as its modality is read: high values are dark in PET, else bright.
Window inUsualSense(const Series& series, const Window& window);

/// Returns the window of slices before a user sets one: uptakeWindow(), else `own`, in the usual sense.
Window usualWindow(const Series& series, const Window& own);

}  // namespace volumen
