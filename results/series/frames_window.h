#pragma once

#include <optional>
#include <utility>

#include "io/study/series.h"
#include "viewer/slice/grey.h"

namespace volumen {

/// Returns the indices of the first and last frame that share a window with frame `index` if files define
/// none. These are all frames of the series, or those of one file if areMadeOneByOne().
std::pair<int, int> framesOfOneWindow(const Series& series, int index);

/// Returns the window from percentile 0.1 to 99.9 of frames `first` to `last`, or of nine evenly spaced ones
/// among them. The result is empty if no frame can be read. Reads files, so it is slow.
std::optional<Window> windowOfFrames(const Series& series, int first, int last);

}  // namespace volumen
