#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// An entry of an archive. Its name is untrusted.
struct ArchiveEntry {
  std::string name;
  enum class Kind { file, folder, other } kind = Kind::other;  ///< other: links, devices
};

/// The entries of a zip archive in sequence. Errors are reasons without the archive's name; an empty one
/// means that it is damaged.
class ArchiveEntries {
 public:
  virtual ~ArchiveEntries() = default;
  /// Returns the next entry; empty after the last.
  virtual Result<std::optional<ArchiveEntry>> next() = 0;
  /// Reads up to `count` bytes of the current entry; 0 at its end.
  virtual Result<std::size_t> read(void* to, std::size_t count) = 0;
};

/// True if an archive holds more than `most` entries, counted by their headers alone, which is quick. Also
/// false if that fails. Runs in a worker if there are any.
bool hasMoreEntries(const std::string& path, std::size_t most, const CancelToken& cancel);

/// Returns a reader of an archive, in a worker if there are any (io/worker).
std::unique_ptr<ArchiveEntries> readArchive(const std::string& path, const CancelToken& cancel);

}  // namespace volumen
