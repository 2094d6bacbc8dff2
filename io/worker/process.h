#pragma once

#include <sys/types.h>

#include <memory>

#include "io/worker/channel.h"
#include "io/worker/costly_files.h"
#include "io/worker/shared_buffer.h"

namespace volumen::worker {

/// One worker as the program sees it. It ends with this.
struct Process {
  pid_t pid = -1;
  Descriptor socket;
  SharedBuffer buffer;
  std::uint64_t bytesAtStart = 0;  ///< its address space before it has done anything
  std::uint64_t mostBytes = 0;     ///< that its address space may grow by now
  std::size_t files = 0;           ///< that it has been given
  bool forAll = false;             ///< prepared for all (prepareToServe)

  Process() = default;
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  /// Sets what memory it may ask for beyond what it began with.
  void limitMemory(std::uint64_t bytes);
  /// Seconds that it has computed for.
  double cpuSeconds() const;
  /// Whether it waits for something, while everybody waits for it.
  bool sleeps() const;
  /// Whether somebody stopped it from outside.
  bool isStopped() const;
  /// Ends it; whether it was killed from outside, by what a worker cannot do to itself.
  bool endsKilled();
};

/// A worker that waits for a request, or a new one; where none can be made, one that another request is done
/// with; nothing where there is none.
std::unique_ptr<Process> takeWorker();
/// A new one, that has told that it is ready.
std::unique_ptr<Process> makeWorker();
/// Why there was none the last time that none could be made.
Failure whyNoWorker();
/// For the next request, unless it has served long enough or there are enough that wait.
void giveBack(std::unique_ptr<Process> worker);

}  // namespace volumen::worker
