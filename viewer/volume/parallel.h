#pragma once

#include <cstdint>
#include <functional>

namespace volumen {

/// Returns the number of threads this process may use: the CPU affinity mask limited by the cgroup's CPU
/// quota and by what a task of a Slurm job has (SLURM_CPUS_PER_TASK), at least 1.
int allowedThreads();

/// Calls work(begin, end) on disjoint parts of [0, count), on `threads` threads (0: all allowed). Parts are
/// assigned in no fixed way, so results must not depend on them.
void parallelFor(std::int64_t count, int threads,
                 const std::function<void(std::int64_t, std::int64_t)>& work);

}  // namespace volumen
