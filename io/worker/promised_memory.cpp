#include "io/worker/promised_memory.h"

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "viewer/volume/available_memory.h"

namespace volumen::worker {

namespace {

struct Promises {
  std::mutex mutex;
  std::condition_variable freed;
  std::uint64_t bytes = 0;
};
Promises& promises() {
  static Promises all;
  return all;
}

}  // namespace

std::optional<PromisedMemory> PromisedMemory::of(std::uint64_t needBytes, const CancelToken* cancel) {
  using namespace std::chrono_literals;
  constexpr std::uint64_t small = std::uint64_t(48) << 20;
  if (needBytes < small) return PromisedMemory(0);
  const std::uint64_t bytes = bytesFor(needBytes);
  // A caller that reads two answers at once would wait for itself.
  const auto longest = std::chrono::steady_clock::now() + 10s;
  Promises& all = promises();
  std::unique_lock lock(all.mutex);
  // Memory that running calls have already taken counts twice, so a call may wait longer than needed.
  while (all.bytes > 0 && !isAvailable(all.bytes + bytes) && std::chrono::steady_clock::now() < longest) {
    if (cancel && cancel->cancelled()) return {};
    all.freed.wait_for(lock, 20ms);
  }
  if (!isAvailable(bytes)) return {};
  all.bytes += bytes;
  return PromisedMemory(bytes);
}

PromisedMemory::~PromisedMemory() {
  if (bytes_ == 0) return;
  Promises& all = promises();
  {
    const std::lock_guard lock(all.mutex);
    all.bytes -= bytes_;
  }
  all.freed.notify_all();
}

}  // namespace volumen::worker
