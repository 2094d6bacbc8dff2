#pragma once

namespace volumen::worker {

/// Has files read in workers from now on (README.md here). Call it first in main(), before there are threads.
/// Returns false if the system does not allow it. Files are then read in this process.
bool start();

/// Has files read in this process from now on.
void stop();

/// Returns whether files are read in workers: workers can be made, and this process is none.
bool isolating();

}  // namespace volumen::worker
