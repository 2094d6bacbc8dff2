#pragma once

namespace volumen::worker {

/// Starts reading files in workers (README.md here). Call it first in main(), before there are threads.
/// Returns false if the system does not allow it. Files are then read in this process.
bool start();

/// Returns to reading files in this process.
void stop();

/// Returns whether files are read in workers: workers can be made, and this process is none.
bool isolating();

}  // namespace volumen::worker
