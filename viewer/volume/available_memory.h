#pragma once

#include <cstdint>
#include <filesystem>

namespace volumen {

/// What sets the limit to the memory of this process: installed memory, a control group, `ulimit -v` or
/// `ulimit -d`.
enum class MemoryBound { machine, controlGroup, addressSpace, data };

/// Memory of this process, in bytes.
struct ProcessMemory {
  std::uint64_t
      available;       ///< It can take this much more now. The largest number if the system does not tell.
  std::uint64_t most;  ///< It could take this much if nothing else ran: the least of all limits.
  MemoryBound bound;   ///< The limit that `available` follows from.
};

/// Reads what `proc` and control groups (of version 1 and 2, parents too) say now. Page cache that can be
/// reclaimed is available. Tests hand over `root`, a folder with files like those of the system.
ProcessMemory processMemory(const std::filesystem::path& root = "/");

}  // namespace volumen
