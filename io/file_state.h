#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>

namespace volumen {

/// Which bytes a path names: the same as long as nobody wrote to the file or put another in its place.
struct FileState {
  std::int64_t size = 0, modifiedNs = 0, changedNs = 0;  ///< since 1970; the first alone lies after copies
  std::int64_t inode = 0, device = 0;
  auto operator<=>(const FileState&) const = default;
};

/// That of a file now; none: there is none.
std::optional<FileState> fileState(const std::string& path);

/// Whether a file was written to so shortly ago that another change might leave no trace in its state: some
/// file systems count times in steps of two seconds.
bool mayChangeUnseen(const FileState& state);

}  // namespace volumen
