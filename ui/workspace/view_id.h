#pragma once

namespace volumen {

/// The unique number of a view of the window.
using ViewId = int;

/// The id for requests of frames and slices that no view shows, while a series is loaded.
inline constexpr ViewId firstImageId = -2;

}  // namespace volumen
