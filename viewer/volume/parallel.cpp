#include "viewer/volume/parallel.h"

#include <sched.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "viewer/volume/control_groups.h"

namespace volumen {

namespace {

// Unused arenas by number of threads. They are kept, because oneTBB 2021.8 never frees an arena that workers
// have entered and searches all that ever existed (its issue 967).
struct IdleArenas {
  std::mutex mutex;
  std::map<int, std::vector<std::unique_ptr<tbb::task_arena>>> arenas;
};
IdleArenas& idle() {
  static IdleArenas all;
  return all;
}

// An arena for a single call. In a shared one, a waiting thread may take up another call's work, which may
// need a lock that this thread holds.
class BorrowedArena {
 public:
  explicit BorrowedArena(int threads) : threads_(threads) {
    const std::lock_guard lock(idle().mutex);
    auto& arenas = idle().arenas[threads];
    if (arenas.empty()) arenas.push_back(std::make_unique<tbb::task_arena>(threads));
    arena_ = std::move(arenas.back());
    arenas.pop_back();
  }
  ~BorrowedArena() {
    const std::lock_guard lock(idle().mutex);
    idle().arenas[threads_].push_back(std::move(arena_));
  }
  BorrowedArena(const BorrowedArena&) = delete;
  BorrowedArena& operator=(const BorrowedArena&) = delete;

  tbb::task_arena* operator->() const { return arena_.get(); }

 private:
  int threads_;
  std::unique_ptr<tbb::task_arena> arena_;
};

int threadsOfJob() {
  const char* text = std::getenv("SLURM_CPUS_PER_TASK");
  const int count = text ? std::atoi(text) : 0;
  return count > 0 ? count : std::numeric_limits<int>::max();
}

}  // namespace

int allowedThreads() {
  static const int count = [] {
    cpu_set_t set;
    CPU_ZERO(&set);
    const int cpus = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return std::max(1, std::min({cpus, threadsOfControlGroups(), threadsOfJob()}));
  }();
  return count;
}

void parallelFor(std::int64_t count, int threads,
                 const std::function<void(std::int64_t, std::int64_t)>& work) {
  const int wanted = threads > 0 ? threads : allowedThreads();
  // Allows more threads than cores if requested; oneTBB would otherwise silently use fewer.
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  std::size_t(std::max(wanted, allowedThreads())));
  const BorrowedArena arena(wanted);
  arena->execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, count),
                      [&](const tbb::blocked_range<std::int64_t>& part) { work(part.begin(), part.end()); });
  });
}

}  // namespace volumen
