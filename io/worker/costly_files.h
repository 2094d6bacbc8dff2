#pragma once

#include <string>

#include "io/worker/serve.h"

namespace volumen::worker {

/// Why a call gave no answer.
enum class Failure { none, ended, slow, wrong, memory, cancelled, noWorker };

/// Remembers, while the program runs, that a file cost a worker that ran `what` of it. Failures that are not
/// the file's (cancelled, noWorker) are not kept.
void rememberCost(Handler what, const std::string& path, Failure why);

/// What `what` of the file, as it is now (device, inode, size, times), has cost before; else none. One that
/// has changed is tried again.
Failure costBefore(Handler what, const std::string& path);

}  // namespace volumen::worker
