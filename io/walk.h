#pragma once

#include <string>
#include <vector>

#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// An entry of a folder that could not be read.
struct UnreadableEntry {
  std::string path, reason;
  bool elsewhere = false;  ///< a link to a folder outside of the search
};

/// The regular files below a path, and unreadable entries with their reasons.
struct FoundFiles {
  std::vector<std::string> files;  ///< sorted by folder and name; several links to a file count once
  std::vector<UnreadableEntry> unreadable;
};

/// Links out of the searched path that are followed.
enum class Links { files, inside };  ///< files: only links to files; inside: none

/// Finds all regular files below `path` (or itself). Symbolic links within it are followed; those out of it
/// as `links` allows. Loops end: each folder and file counts once, by device and inode. FIFOs, sockets and
/// devices are unreadable. What this program writes and has not completed (isAsideName()) is left out. The
/// Error: the path does not exist, or is neither a file nor a folder.
Result<FoundFiles> findFiles(const std::string& path, const CancelToken& cancel, Links links = Links::files);

/// Returns the regular files directly in these folders, each once; links are followed. Unreadable folders are
/// empty, and incomplete files are left out, as findFiles() does.
std::vector<std::string> filesDirectlyIn(const std::vector<std::string>& folders);

}  // namespace volumen
