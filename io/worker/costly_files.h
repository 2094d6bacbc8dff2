#pragma once

#include <string>

#include "io/worker/serve.h"

namespace volumen::worker {

/// The reason why a call gave no answer.
enum class Failure {
  none,
  ended,  ///< the worker crashed or exited
  slow,
  wrong,  ///< the answer makes no sense
  memory,
  cancelled,
  noWorker,   ///< there was no worker and none could be made
  noRoom,     ///< no worker, as this process may not make files that large, shared memory among them
  noOpening,  ///< the program may open no more files or descriptors
  stopped,    ///< stopped from outside
  killed,     ///< killed from outside
  scarce      ///< there is not enough memory for a worker and its answer
};

/// Returns whether a failure says nothing about the file, so that another try may read it.
inline bool isOfMachine(Failure failure) { return failure >= Failure::cancelled; }

/// Records, while the program runs, that reading `path` by `what` cost a worker. Failures of the machine are
/// not recorded.
void rememberCost(Handler what, const std::string& path, Failure why);

/// Returns the failure that reading `path` by `what` caused before, or none. A file that has changed since
/// (FileState) is tried again.
Failure costBefore(Handler what, const std::string& path);

}  // namespace volumen::worker
