#pragma once

#include <chrono>

namespace volumen {

/// Returns the wall clock in ms since a fixed time.
inline double wallMs() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace volumen
