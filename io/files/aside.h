#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <utility>

#include "viewer/volume/result.h"

namespace volumen {

/// Name of temporary files and folders, beside their final place, until they are complete (mkstemp).
inline constexpr const char* asideName = ".volumen-XXXXXX";

/// Returns whether a file name, without its folder, is one that mkstemp makes of asideName.
bool isAsideName(std::string_view name);

/// Returns the end of a name's symbolic links, even if nothing exists there.
std::string endOfLinks(const std::string& name);

/// Locks an open temporary file or folder, so that other programs do not take it for an abandoned one.
/// Returns false if one has already removed it: another one must be made.
bool claimAside(int descriptor);

/// Returns the permission bits that this process does not grant to new files (its umask).
mode_t rightsKept();

/// Removes temporary files that killed programs left in a folder ("": the working directory). Looks once a
/// run.
void sweepAside(const std::string& folder);

/// As sweepAside(), but always looks: a process of this run was killed.
void sweepAsideAgain(const std::string& folder);

/// A folder that appears whole or not at all: it is filled beside its final place, locked, and removed unless
/// it gets its name.
class FolderAside {
 public:
  /// Makes it in `parent`, and removes what killed programs left there. The Error is the system's reason.
  static Result<FolderAside> in(const std::string& parent);
  FolderAside(FolderAside&& other) noexcept
      : path_(std::exchange(other.path_, {})), descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderAside& operator=(FolderAside&&) = delete;
  ~FolderAside();

  const std::string& path() const { return path_; }
  /// Gives it its name, and the rights of new folders. The Error is the system's reason.
  Status become(const std::string& target);

 private:
  FolderAside(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  std::string path_;  // empty: it is not its own any more
  int descriptor_;
};

}  // namespace volumen
