#include "io/index/files_below.h"

#include <sys/stat.h>

#include <cerrno>
#include <filesystem>
#include <map>

#include "io/dicom/directory.h"
#include "io/files/session_file.h"
#include "io/index/schema.h"
#include "io/walk.h"
#include "io/zip_archive.h"

namespace volumen {
namespace {

// The canonical paths of folders; each is resolved once.
class RealFolders {
 public:
  const std::string& of(const std::string& folder) {
    const auto known = real_.find(folder);
    if (known != real_.end()) return known->second;
    std::error_code error;
    const std::filesystem::path real = std::filesystem::canonical(folder, error);
    return real_[folder] = error ? folder : real.string();
  }

 private:
  std::map<std::string, std::string> real_;
};

}  // namespace

Result<ImportRoot> importRoot(const std::string& path) {
  if (path.starts_with("phantom:")) return Error{path + ": phantoms are made, not imported."};
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(path, error);
  if (error)
    return Error{
        "Cannot open " + path + ": " +
        (error == std::errc::no_such_file_or_directory ? "no such file or folder" : error.message()) + "."};
  if (isZipArchive(path))
    return Error{path + " is a zip archive: unpack it and import the folder, as its files do not stay."};
  if (isSessionFile(path)) return Error{path + " is a session: there is nothing to import in it."};
  if (dicom::isDirectoryFile(path)) return ImportRoot{real.parent_path().string(), true};
  return ImportRoot{real.string(), false};
}

Result<FilesBelow> filesBelow(const ImportRoot& root, const std::string& indexFolder,
                              const CancelToken& cancel) {
  Result<FoundFiles> found = findFiles(root.path, cancel, root.inside ? Links::inside : Links::files);
  if (!found) return found.error();
  FilesBelow below;
  RealFolders folders;
  const auto onDisk = [&](const std::string& path) {
    const std::size_t slash = path.find_last_of('/');
    return FileOnDisk{folders.of(slash == 0 ? "/" : path.substr(0, slash)), path.substr(slash + 1), {}};
  };
  for (const auto& [path, reason, elsewhere] : found->unreadable)
    below.unreadable.push_back({onDisk(path), reason + ".", elsewhere});
  const std::string ownFolder = folders.of(indexFolder);
  for (const std::string& path : found->files) {
    const std::optional<FileState> state = fileState(path);
    FileOnDisk file = onDisk(path);
    // the file has just been deleted
    if (!state || (file.folder == ownFolder && isFileOfIndex(file.name))) continue;
    file.state = *state;
    below.files.push_back(std::move(file));
  }
  return below;
}

bool exists(const std::string& path) {
  struct stat status {};
  return lstat(path.c_str(), &status) == 0 || (errno != ENOENT && errno != ENOTDIR);
}

bool isOnline(const std::string& folder, std::int64_t device) {
  struct stat status {};
  return stat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
         std::int64_t(status.st_dev) == device;
}

}  // namespace volumen
