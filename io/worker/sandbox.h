#pragma once

namespace volumen::worker {

/// Whether this build looks over its own memory (address or thread sanitizer): then neither the memory nor
/// the system calls of workers are limited, for the sanitizer needs both.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// Takes away from this process, for good, what the parent of workers does not need: all descriptors but
/// standard input, output and error (which lead nowhere) and `socket`, capabilities, new privileges, and all
/// system calls but those that fork, wait, read files and do what a worker may do; it has no network and
/// writes no files. False where the system refuses it.
bool becomeZygote(int socket);

/// Takes away from this process, for good, what a worker does not need: all descriptors but standard input,
/// output and error (which lead nowhere) and `socket`, core dumps, files that grow, new privileges, and all
/// system calls but those that read what is open, ask for memory and talk through `socket`. What is not
/// allowed ends the process. False where the system refuses it.
bool enterSandbox(int socket);

}  // namespace volumen::worker
