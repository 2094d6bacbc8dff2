#pragma once

#include <string>
#include <vector>

#include "io/index/reading.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Starting point of an import.
struct ImportRoot {
  std::string path;     ///< path without symbolic links; for a DICOMDIR its folder
  bool inside = false;  ///< true if links out of it are not followed
};

/// Returns the root for a path. The Error: the path does not exist, or is not a file or folder of its own (a
/// zip archive, a session, a phantom).
Result<ImportRoot> importRoot(const std::string& path);

/// An entry that could not be read.
struct UnreadableOnDisk {
  FileOnDisk entry;  ///< entry without its state
  std::string reason;
  bool elsewhere = false;  ///< same as UnreadableEntry::elsewhere
};

/// The files below a root at this moment, and unreadable entries.
struct FilesBelow {
  std::vector<FileOnDisk> files;  ///< sorted by folder and name
  std::vector<UnreadableOnDisk> unreadable;
};

/// Finds every file below a root once, however many links lead to it, except the files of the index itself.
Result<FilesBelow> filesBelow(const ImportRoot& root, const std::string& indexFolder,
                              const CancelToken& cancel);

/// True if a path exists, of any kind.
bool exists(const std::string& path);

/// True if the folder exists on the device that is recorded for it. Otherwise a disk may have been removed,
/// and the state of its files is unknown.
bool isOnline(const std::string& folder, std::int64_t device);

}  // namespace volumen
