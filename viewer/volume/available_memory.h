#pragma once

#include <cstdint>
#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// Limits of this process's memory: installed memory, a control group, `ulimit -v`, or `ulimit -d`.
enum class MemoryBound { machine, controlGroup, addressSpace, data };

/// Memory of this process, in bytes.
struct ProcessMemory {
  std::uint64_t available;  ///< Memory it can still take now; the largest number if unknown
  std::uint64_t most;       ///< Memory it could take if nothing else ran: the lowest limit
  MemoryBound bound;        ///< The limit that determines `available`
};

/// Reads the current state from `proc` and control groups (versions 1 and 2, including parents). Reclaimable
/// page cache counts as available. Tests pass a `root` folder with files like those of the system.
ProcessMemory processMemory(const std::string& root = "/");

/// Returns bytes as text: whole MiB ("640 MiB"), from 1 GiB on with one decimal ("2.5 GiB").
std::string memoryText(std::uint64_t bytes);

/// Returns whether this process can take `bytes` more and keep 32 MiB in reserve.
bool isAvailable(std::uint64_t bytes);

/// Returns an Error that `what` ("a.nrrd: reading it") needs `bytes`, with the available bytes and a remedy.
Error tooLittleMemory(const std::string& what, std::uint64_t bytes);

/// Returns tooLittleMemory() if `bytes` more are not available.
Status checkAvailable(const std::string& what, std::uint64_t bytes);

/// Names in messages what the limit of `ulimit -d` is from for the rest of the process: an option of this
/// program.
void nameDataLimit(const std::string& option);

/// Throws std::bad_alloc if `bytes` is at least 32 MiB and not available. Control groups kill processes that
/// exceed their limit instead of failing the allocation.
void expectAvailable(std::uint64_t bytes);

/// Switches off expectAvailable() for the rest of the process. Workers may not open the files it reads.
void expectAllAvailable();

}  // namespace volumen
