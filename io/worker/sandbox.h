#pragma once

namespace volumen::worker {

/// True if this build checks its own memory (address or thread sanitizer). Workers then have no limits on
/// memory or system calls, as the sanitizer needs both.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// Permanently drops everything that the parent of workers does not need. It keeps `socket` and standard
/// input, output and error, which lead nowhere. Capabilities and new privileges are dropped. The only system
/// calls left are those that fork, wait and read files, and those of workers: no network, no writing of
/// files. Returns false if the system refuses.
bool becomeZygote(int socket);

/// Permanently drops everything that a worker does not need. It keeps `socket` and standard input, output and
/// error, which lead nowhere. Core dumps, growing files and new privileges are ruled out. The only system
/// calls left read open files, allocate memory and talk through `socket`. Any other call ends the process.
/// Returns false if the system refuses.
bool enterSandbox(int socket);

}  // namespace volumen::worker
