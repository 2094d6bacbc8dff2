#pragma once

#include <chrono>

namespace volumen {

/// A clock for what takes longer than a few microseconds, ms.
inline double nowMs() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace volumen
