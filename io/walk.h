#pragma once

#include <string>
#include <vector>

#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// An entry of a folder that could not be looked at.
struct UnreadableEntry {
  std::string path, reason;
  bool elsewhere = false;  ///< it leads to a folder that lies elsewhere and is not part of what is searched
};

/// The regular files under a path, and the entries that could not be looked at, each with its reason.
struct FoundFiles {
  std::vector<std::string>
      files;  ///< sorted by folder and name; each file once, however many links lead to it
  std::vector<UnreadableEntry> unreadable;
};

/// Which symbolic links that lead out of its path a search follows.
enum class Links { files, inside };  ///< files: those to files; inside: none

/// Finds all regular files under `path` (itself, where it is one). Symbolic links are followed where they
/// stay below it, else as `links` says; loops end (each folder and file once, by device and inode); FIFOs,
/// sockets and devices are unreadable. An Error where there is no such path, or it is neither a file nor a
/// folder.
Result<FoundFiles> findFiles(const std::string& path, const CancelToken& cancel, Links links = Links::files);

/// The regular files that lie directly in these folders, each once; links are followed. Folders that cannot
/// be read hold none.
std::vector<std::string> filesDirectlyIn(const std::vector<std::string>& folders);

}  // namespace volumen
