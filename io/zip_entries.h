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

/// The entries of a zip archive, front to back. Errors are reasons without the archive's name; empty where
/// there is none but that it is damaged.
class ArchiveEntries {
 public:
  virtual ~ArchiveEntries() = default;
  /// The next entry; nothing behind the last.
  virtual Result<std::optional<ArchiveEntry>> next() = 0;
  /// Up to `count` bytes of the entry in hand; 0 at its end.
  virtual Result<std::size_t> read(void* to, std::size_t count) = 0;
};

/// Whether an archive holds more than `most` entries, by their headers alone, which is quick; false, too,
/// where that cannot be told so. In a worker where there are any.
bool hasMoreEntries(const std::string& path, std::size_t most, const CancelToken& cancel);

/// Reads an archive, in a worker where there are any (io/worker).
std::unique_ptr<ArchiveEntries> readArchive(const std::string& path, const CancelToken& cancel);

}  // namespace volumen
