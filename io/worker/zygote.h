#pragma once

#include <sys/types.h>

#include <mutex>
#include <optional>

#include "io/worker/channel.h"

namespace volumen::worker {

/// A small process that forks workers, made before the program has threads or much memory: forking a large
/// one takes tens of milliseconds, and a copy of locks that other threads hold.
class Zygote {
 public:
  static Zygote& instance();

  ~Zygote() { stop(); }
  /// Forks it. False where the system does not let it, or has no seccomp.
  bool start();
  /// Ends it, and all workers with it.
  void stop();
  bool runs() const { return bool(socket_); }
  /// Whether nothing has become of it: where it was killed its workers were, too.
  bool isWell();

  /// A new worker that serves the other end of `socket` and answers through `buffer`, prepared for all or for
  /// headers (prepareToServe); -1 where there is none.
  pid_t fork(Descriptor socket, Descriptor buffer, bool forAll);
  /// Waits until a worker is gone, which is killed where it does not end by itself within `graceMs`: its
  /// status, as wait() gives it, where it did.
  std::optional<int> end(pid_t worker, int graceMs);

 private:
  bool ask(const Message& question, Message& answer);
  void reap();

  std::mutex mutex_;
  Descriptor socket_;
  pid_t pid_ = -1;  // -1 with a socket: it is gone
};

}  // namespace volumen::worker
