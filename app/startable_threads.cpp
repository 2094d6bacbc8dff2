#include "app/startable_threads.h"

#include <tbb/global_control.h>

#include <future>
#include <system_error>
#include <thread>
#include <vector>

#include "viewer/volume/parallel.h"

namespace volumen {

void keepToStartableThreads() {
  const std::size_t wanted = std::size_t(allowedThreads()) - 1;
  std::vector<std::thread> started;
  std::promise<void> counted;
  const std::shared_future<void> end = counted.get_future().share();
  try {
    while (started.size() < wanted) started.emplace_back([end] { end.wait(); });
  } catch (const std::system_error&) {
    // Never destroyed: oneTBB would then start the threads that it held back.
    static const auto* limit =
        new tbb::global_control(tbb::global_control::max_allowed_parallelism, started.size() / 2 + 1);
    (void)limit;
  }
  counted.set_value();
  for (std::thread& thread : started) thread.join();
}

}  // namespace volumen
