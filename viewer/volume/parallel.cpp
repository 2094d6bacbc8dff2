#include "viewer/volume/parallel.h"

#include <sched.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace volumen {

namespace {

// cgroup v2: "max 100000" or "QUOTA PERIOD", both in microseconds.
int cgroupThreads() {
  std::ifstream file("/sys/fs/cgroup/cpu.max");
  std::string quota;
  double period = 0;
  if (!(file >> quota >> period) || quota == "max" || period <= 0) return 1 << 20;
  return std::max(1, int(std::ceil(std::atof(quota.c_str()) / period)));
}

}  // namespace

int allowedThreads() {
  static const int count = [] {
    cpu_set_t set;
    CPU_ZERO(&set);
    const int cpus = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return std::max(1, std::min(cpus, cgroupThreads()));
  }();
  return count;
}

void parallelFor(std::int64_t count, int threads,
                 const std::function<void(std::int64_t, std::int64_t)>& work) {
  const int wanted = threads > 0 ? threads : allowedThreads();
  // More threads than cores only where asked for; without this oneTBB would quietly use fewer.
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  std::size_t(std::max(wanted, allowedThreads())));
  tbb::task_arena arena(wanted);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, count),
                      [&](const tbb::blocked_range<std::int64_t>& part) { work(part.begin(), part.end()); });
  });
}

}  // namespace volumen
