#pragma once

namespace volumen {

/// The unique number of a view of the window.
using ViewId = int;

/// Ids for requests of frames and slices that no view shows: to measure them, and while a series is loaded.
inline constexpr ViewId measuredId = -1, firstImageId = -2;

}  // namespace volumen
