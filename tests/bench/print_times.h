#pragma once

#include <QtGlobal>
#include <algorithm>
#include <vector>

#include "viewer/evaluation/statistics.h"

namespace volumen::bench {

/// Prints the median and the largest of the measured times.
inline void printTimes(const char* what, const std::vector<double>& ms) {
  qInfo("%s: median %.1f ms, largest %.1f ms of %d", what, median(ms), *std::ranges::max_element(ms),
        int(ms.size()));
}

}  // namespace volumen::bench
