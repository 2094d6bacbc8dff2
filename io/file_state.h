#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>

namespace volumen {

/// Identifies the bytes of a file: it stays equal until the file is written to or replaced.
struct FileState {
  /// times since 1970; modifiedNs can be set by copying, changedNs cannot
  std::int64_t size = 0, modifiedNs = 0, changedNs = 0;
  std::int64_t inode = 0, device = 0;
  auto operator<=>(const FileState&) const = default;
};

/// Returns the current state of a file; empty if it does not exist.
std::optional<FileState> fileState(const std::string& path);

/// True if a file was written to so recently that another change might not alter its state: some file systems
/// count time in steps of two seconds.
bool mayChangeUnseen(const FileState& state);

}  // namespace volumen
