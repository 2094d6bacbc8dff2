#pragma once

#include <sys/types.h>

#include <memory>

#include "io/worker/channel.h"
#include "io/worker/costly_files.h"
#include "io/worker/shared_buffer.h"

namespace volumen::worker {

/// A worker as the program sees it. Destroying it ends the worker.
struct Process {
  pid_t pid = -1;
  Descriptor socket;
  SharedBuffer buffer;
  std::uint64_t bytesAtStart = 0;  ///< size of its address space before its first request
  std::uint64_t mostBytes = 0;     ///< current limit on the growth of its address space
  std::size_t files = 0;           ///< number of files it has been given
  bool forAll = false;             ///< prepared for all (prepareToServe)

  Process() = default;
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  /// Limits the memory it may allocate beyond `bytesAtStart`.
  void limitMemory(std::uint64_t bytes);
  /// Returns its CPU time in seconds.
  double cpuSeconds() const;
  /// Returns whether it waits (state S of ps), although it is its turn to work.
  bool sleeps() const;
  /// Returns whether it was stopped from outside (state T of ps).
  bool isStopped() const;
  /// Ends it. Returns whether it was killed from outside, by a signal that a worker cannot cause itself.
  bool endsKilled();
};

/// Returns an idle worker or a new one. If none can be made, waits for one that finishes another request.
/// Returns null if there is none.
std::unique_ptr<Process> takeWorker();
/// Returns a new worker that has reported ready.
std::unique_ptr<Process> makeWorker();
/// Returns the reason why a worker could not be made, the last time that happened.
Failure whyNoWorker();
/// Keeps a worker for the next request, unless it has served long enough or enough workers are idle.
void giveBack(std::unique_ptr<Process> worker);

}  // namespace volumen::worker
