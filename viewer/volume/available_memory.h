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

/// "640 MiB", "2.5 GiB": whole MiB, from 1 GiB on with a tenth.
std::string memoryText(std::uint64_t bytes);

/// Whether `bytes` more are available, and a little besides.
bool isAvailable(std::uint64_t bytes);

/// Says that `what` ("a.nrrd: reading it") needs so many bytes, how many are available, and what to do.
Error tooLittleMemory(const std::string& what, std::uint64_t bytes);

/// tooLittleMemory() if `bytes` more are not available.
Status checkAvailable(const std::string& what, std::uint64_t bytes);

/// Throws std::bad_alloc if `bytes` are many and not available: a control group kills whoever takes more than
/// there is, without a word.
void expectAvailable(std::uint64_t bytes);

/// From now on expectAvailable() asks nothing: in processes that may not open files.
void expectAllAvailable();

}  // namespace volumen
