#pragma once

#include <chrono>

namespace volumen {

/// Wall clock since some fixed time, ms.
inline double wallMs() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace volumen
