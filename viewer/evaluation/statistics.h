#pragma once

#include <vector>

namespace volumen {

/// Returns the middle value, or the mean of the middle two; 0 for no values.
double median(std::vector<double> values);
/// Returns the smallest value; 0 for no values.
double minimum(const std::vector<double>& values);

/// Returns the time, in ms, that this process has used of all processors. On a shared machine it tells more
/// than the wall clock.
double processorMs();

}  // namespace volumen
