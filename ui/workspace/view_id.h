#pragma once

namespace volumen {

/// Names a view of the window; no number is given twice.
using ViewId = int;

/// As which frames and slices are asked for that no view shows: to be measured, and while a series is loaded.
inline constexpr ViewId measuredId = -1, firstImageId = -2;

}  // namespace volumen
