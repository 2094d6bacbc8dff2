#pragma once

#include <string>
#include <utility>
#include <vector>

#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// The regular files under a path, and the entries that could not be looked at, each with its reason.
struct FoundFiles {
  std::vector<std::string>
      files;  ///< sorted by folder and name; each file once, however many links lead to it
  std::vector<std::pair<std::string, std::string>> unreadable;  ///< path, reason
};

/// Which symbolic links a search follows.
enum class Links { all, inside };  ///< inside: those that stay below its path

/// Finds all regular files under `path` (itself, where it is one). Symbolic links are followed as `links`
/// says, loops end (each folder and file once, by device and inode); FIFOs, sockets and devices are left out.
/// An Error where there is no such path.
Result<FoundFiles> findFiles(const std::string& path, const CancelToken& cancel, Links links = Links::all);

/// The regular files that lie directly in these folders, each once; links are followed. Folders that cannot
/// be read hold none.
std::vector<std::string> filesDirectlyIn(const std::vector<std::string>& folders);

}  // namespace volumen
