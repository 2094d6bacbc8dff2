#include "io/files/private_folder.h"

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
  for (auto at = missing.rbegin(); at != missing.rend(); ++at)
    if (mkdir(at->c_str(), S_IRWXU) != 0 && errno != EEXIST)
      return Error{"Cannot make the folder " + folder + ": " + std::strerror(errno) + "."};
  if (!fs::is_directory(folder, error))
    return Error{"Cannot make the folder " + folder + ": a file has its name."};
  if (access(folder.c_str(), W_OK) != 0)
    return Error{"Cannot write to the folder " + folder + ": " + std::strerror(errno) + "."};
  return {};
}

}  // namespace volumen
