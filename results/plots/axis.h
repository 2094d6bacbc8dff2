#pragma once

#include <QString>
#include <vector>

namespace volumen {

/// One axis of a chart: maps values to pixels.
struct Axis {
  double low = 0, high = 1;  ///< values; positive if logarithmic
  double atLow = 0, atHigh = 1;
  bool logarithmic = false, wholeNumbers = false;

  double pixelOf(double value) const;
};

struct Tick {
  double value = 0;
  bool labelled = true;
};

/// Returns round values along an axis: 1, 2, 5 of each decade. Only as many are labelled as are easily read.
std::vector<Tick> ticksOf(const Axis& axis);

/// Returns "0.01", "500", "20000".
QString tickText(double value);

}  // namespace volumen
