#pragma once

#include <vector>

namespace volumen {

/// The middle value (of an even number, the mean of the middle two); 0 of none.
double median(std::vector<double> values);
/// The smallest value; 0 of none.
double minimum(const std::vector<double>& values);

/// What this process has used of all processors, ms: on a machine that others use too it tells more than the
/// wall clock.
double processorMs();

}  // namespace volumen
