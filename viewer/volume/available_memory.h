#pragma once

#include <cstdint>
#include <filesystem>

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
ProcessMemory processMemory(const std::filesystem::path& root = "/");

}  // namespace volumen
