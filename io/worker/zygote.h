#pragma once

#include <sys/types.h>

#include <mutex>

#include "io/worker/channel.h"

namespace volumen::worker {

/// A small process that forks workers, made before the program has threads or much memory: forking a large
/// one takes tens of milliseconds, and a copy of locks that other threads hold.
class Zygote {
 public:
  static Zygote& instance();

  /// Forks it. False where the system does not let it, or has no seccomp.
  bool start();
  /// Ends it, and all workers with it.
  void stop();
  bool runs() const { return bool(socket_); }

  /// A new worker that serves the other end of `socket` and answers through `buffer`; -1 where there is none.
  pid_t fork(Descriptor socket, Descriptor buffer);
  /// Kills a worker and waits until it is gone.
  void end(pid_t worker);

 private:
  bool ask(const Message& question, Message& answer);

  std::mutex mutex_;
  Descriptor socket_;
  pid_t pid_ = -1;
};

}  // namespace volumen::worker
