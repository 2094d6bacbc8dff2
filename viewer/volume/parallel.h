#pragma once

#include <cstdint>
#include <functional>

namespace volumen {

/// How many threads this process may use: the CPU affinity mask, cut by the cgroup's CPU quota; at least 1.
int allowedThreads();

/// Calls work(begin, end) over disjoint parts of [0, count), on `threads` threads (0: all allowed). Which
/// part runs where is not fixed, so results must not depend on it.
void parallelFor(std::int64_t count, int threads,
                 const std::function<void(std::int64_t, std::int64_t)>& work);

}  // namespace volumen
