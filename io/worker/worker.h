#pragma once

namespace volumen::worker {

/// From now on files are read in workers (README.md here). To be called first in main(), before there are
/// threads. False where the system does not let it: then they are read in this process.
bool start();

/// From now on files are read in this process.
void stop();

/// Whether files are read in workers: workers can be made, and this process is none.
bool isolating();

}  // namespace volumen::worker
