#pragma once

#include <optional>
#include <utility>

#include "io/study/series.h"
#include "viewer/slice/grey.h"

namespace volumen {

/// Returns the first and the last of the frames that share a window with frame `index` where files have none:
/// all of a series, but those of one file where pictures areMadeOneByOne().
std::pair<int, int> framesOfOneWindow(const Series& series, int index);

/// Returns P0.1 .. P99.9 of frames `first` to `last`, or of nine evenly spaced ones among them. Returns
/// nothing if none can be read. Slow.
std::optional<Window> windowOfFrames(const Series& series, int first, int last);

}  // namespace volumen
