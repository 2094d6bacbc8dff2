#pragma once

#include <sys/types.h>

#include <mutex>
#include <optional>

#include "io/worker/channel.h"

namespace volumen::worker {

/// A small process that forks workers. It is made before the program has threads or much memory. Forking a
/// large process takes tens of milliseconds and copies locks that other threads hold.
class Zygote {
 public:
  static Zygote& instance();

  ~Zygote() { stop(); }
  /// Forks the zygote. Returns false if the system does not allow it or lacks seccomp.
  bool start();
  /// Ends the zygote and all its workers.
  void stop();
  bool runs() const { return bool(socket_); }
  /// Returns whether the zygote still lives. If it was killed, so were its workers.
  bool isWell();

  /// Returns a new worker that serves the other end of `socket` and answers through `buffer`. It is prepared
  /// for all or for headers (prepareToServe). Returns -1 if none can be made.
  pid_t fork(Descriptor socket, Descriptor buffer, bool forAll);
  /// Waits until a worker is gone and kills it after `graceMs`. Returns its status, as wait() gives it, if it
  /// ended by itself.
  std::optional<int> end(pid_t worker, int graceMs);

 private:
  bool ask(const Message& question, Message& answer);
  void reap();

  std::mutex mutex_;
  Descriptor socket_;
  pid_t pid_ = -1;  // -1 with a socket: the zygote is gone
};

}  // namespace volumen::worker
