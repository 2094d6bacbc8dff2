#pragma once

#include <chrono>
#include <cstdint>

namespace volumen {

/// The time stamp counter: cheap enough to be read once a row of a slice; 0 where there is none.
inline std::int64_t ticks() {
#ifdef __x86_64__
  return std::int64_t(__builtin_ia32_rdtsc());
#else
  return 0;
#endif
}

/// A clock for what takes longer, ms.
inline double nowMs() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace volumen
