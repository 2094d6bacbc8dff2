#pragma once

namespace volumen {

/// From now on no more threads are used than the system lets this process start (half of them, as workers are
/// processes that count, too): oneTBB ends a program whose thread cannot be started.
void keepToStartableThreads();

}  // namespace volumen
