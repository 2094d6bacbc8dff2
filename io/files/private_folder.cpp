#include "io/files/private_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

namespace volumen {

Status makePrivateFolder(const std::string& folder) {
  namespace fs = std::filesystem;
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, error); at = at.parent_path())
    missing.push_back(at);
  for (auto at = missing.rbegin(); at != missing.rend(); ++at) {
    if (mkdir(at->c_str(), S_IRWXU) != 0 && errno != EEXIST)
      return Error{"Cannot make the folder " + folder + ": " + std::strerror(errno) + "."};
    if (Status s = makeNamesLast(at->parent_path().string()); !s) return s;
  }
  if (!fs::is_directory(folder, error))
    return Error{"Cannot make the folder " + folder + ": a file has its name."};
  if (access(folder.c_str(), W_OK) != 0)
    return Error{"Cannot write to the folder " + folder + ": " + std::strerror(errno) + "."};
  return {};
}

Status makeNamesLast(const std::string& folder) {
  const int fd = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // Some disks cannot do this, and some folders may be written but not read.
  const bool isDone = fd < 0 || fsync(fd) == 0 || errno == EINVAL || errno == EROFS || errno == ENOSYS;
  const int error = errno;
  if (fd >= 0) close(fd);
  return isDone ? Status()
                : Error{"Cannot write to the folder " + folder + ": " + std::strerror(error) + "."};
}

}  // namespace volumen
