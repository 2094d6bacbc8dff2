#include "io/archive/instance_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "io/archive/fetch_archive.h"
#include "io/files/aside.h"

namespace volumen {

InstanceFolder::InstanceFolder(std::string folder, std::function<void()> onStored)
    : folder_(std::move(folder)), onStored_(std::move(onStored)) {
  sweepAside(folder_);
}

InstanceFolder::~InstanceFolder() {
  while (!open_.empty()) drop(open_.begin()->first);
}

std::string InstanceFolder::pathOf(const std::string& sopInstanceUid) const {
  return folder_ + "/" + nameForUid(sopInstanceUid) + ".dcm";
}

bool InstanceFolder::has(const std::string& sopInstanceUid) const {
  std::error_code ignored;
  return std::filesystem::exists(pathOf(sopInstanceUid), ignored);
}

Result<std::string> InstanceFolder::begin(const std::string&) {
  std::string path = folder_ + "/" + asideName;
  const int descriptor = ::mkstemp(path.data());
  if (descriptor < 0) return Error{"Cannot write in " + folder_ + ": " + std::strerror(errno) + "."};
  claimAside(descriptor);
  open_[path] = descriptor;
  return path;
}

Status InstanceFolder::end(const std::string& sopInstanceUid, const std::string& path) {
  const int descriptor = open_.at(path);
  struct stat file {};
  // What is found later counts as whole, so it must be on the disk before it has its name.
  const bool isKept = ::fdatasync(descriptor) == 0 && ::fstat(descriptor, &file) == 0 &&
                      ::fchmod(descriptor, 0666 & ~rightsKept()) == 0 &&
                      ::rename(path.c_str(), pathOf(sopInstanceUid).c_str()) == 0;
  if (!isKept) {
    const std::string why = std::strerror(errno);
    drop(path);
    return Error{"Cannot write in " + folder_ + ": " + why + "."};
  }
  ::close(descriptor);
  open_.erase(path);
  bytes_ += std::uint64_t(file.st_size);
  if (onStored_) onStored_();
  return {};
}

void InstanceFolder::drop(const std::string& path) {
  ::unlink(path.c_str());
  ::close(open_.at(path));
  open_.erase(path);
}

}  // namespace volumen
