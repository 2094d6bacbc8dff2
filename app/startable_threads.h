#pragma once

namespace volumen {

/// Limits the threads to half of those that the system lets this process start, as worker processes count,
/// too. oneTBB ends a program if it cannot start a thread.
void keepToStartableThreads();

}  // namespace volumen
