#pragma once

#include <string>

#include "io/worker/serve.h"

namespace volumen::worker {

/// Why a call gave no answer.
enum class Failure {
  none,
  ended,  ///< the worker ended by what it did
  slow,
  wrong,  ///< it said what makes no sense
  memory,
  cancelled,
  noWorker,   ///< there was none, and none could be made
  noRoom,     ///< the same, as this process may write no files of some size, memory among them
  noOpening,  ///< the program may not open more files, or have more descriptors
  stopped,    ///< from outside
  killed      ///< from outside
};

/// Whether a failure says nothing of the file: in a healthy worker, another time, it may be read.
inline bool isOfMachine(Failure failure) { return failure >= Failure::cancelled; }

/// Remembers, while the program runs, that a file cost a worker that ran `what` of it. Failures of the
/// machine are not kept.
void rememberCost(Handler what, const std::string& path, Failure why);

/// What `what` of the file, as it is now (FileState), has cost before; else none. One that
/// has changed is tried again.
Failure costBefore(Handler what, const std::string& path);

}  // namespace volumen::worker
