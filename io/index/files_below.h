#pragma once

#include <string>
#include <vector>

#include "io/index/reading.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// What an import begins with.
struct ImportRoot {
  std::string path;     ///< without symbolic links; of a DICOMDIR its folder
  bool inside = false;  ///< links that lead out of it are not followed
};

/// The root that a path stands for. An Error where there is no such path, and for what is no file or folder
/// of its own: a zip archive, a session, a phantom.
Result<ImportRoot> importRoot(const std::string& path);

/// What could not be looked at, and why: a sentence.
struct UnreadableOnDisk {
  FileOnDisk entry;  ///< without state
  std::string reason;
  bool elsewhere = false;  ///< as UnreadableEntry has it
};

/// The files below a root as they are now, and what could not be looked at.
struct FilesBelow {
  std::vector<FileOnDisk> files;  ///< sorted by folder and name
  std::vector<UnreadableOnDisk> unreadable;
};

/// Looks at every file below a root once, whatever links lead to it, but for the files of the index itself.
Result<FilesBelow> filesBelow(const ImportRoot& root, const std::string& indexFolder,
                              const CancelToken& cancel);

/// Whether a file is there, whatever it is.
bool exists(const std::string& path);

/// Whether the folder is there and on the device that it was on: else a disk was removed, and nothing can be
/// said of its files.
bool isOnline(const std::string& folder, std::int64_t device);

}  // namespace volumen
