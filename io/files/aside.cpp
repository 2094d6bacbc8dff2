#include "io/files/aside.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>

namespace volumen {
namespace {

bool isFirstTime(const std::string& folder) {
  static std::mutex mutex;
  static std::set<std::string> looked;
  const std::scoped_lock one(mutex);
  return looked.insert(folder).second;
}

// Removes a file that is this user's if no running process holds its lock. The lock is kept until it is gone,
// so that whoever has just made it notices (claimAside).
void removeIfLeft(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  if (fd < 0) return;
  struct stat status {};
  const bool left =
      ::fstat(fd, &status) == 0 && status.st_uid == ::geteuid() && ::flock(fd, LOCK_EX | LOCK_NB) == 0;
  std::error_code ignored;
  if (left) std::filesystem::remove_all(path, ignored);
  ::close(fd);
}

}  // namespace

bool isAsideName(std::string_view name) {
  constexpr std::string_view pattern = asideName, prefix = pattern.substr(0, pattern.find('X'));
  return name.size() == pattern.size() && name.starts_with(prefix) &&
         std::ranges::all_of(name.substr(prefix.size()),
                             [](unsigned char c) { return std::isalnum(c) != 0; });
}

std::string endOfLinks(const std::string& name) {
  constexpr int mostLinks = 40;  // the system's limit
  std::filesystem::path place = name;
  std::error_code none;
  for (int n = 0; n < mostLinks && std::filesystem::is_symlink(place, none); ++n)
    place = place.parent_path() / std::filesystem::read_symlink(place, none);
  return place.string();
}

// A file system without locks has nothing that others could remove.
bool claimAside(int descriptor) {
  while (::flock(descriptor, LOCK_EX) != 0 && errno == EINTR) {
  }
  struct stat status {};
  return ::fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

// Reads the umask without changing it: files that another thread creates meanwhile would get wrong rights.
mode_t rightsKept() {
  static const mode_t mask = [] {
    constexpr std::string_view key = "Umask:";
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with(key)) return mode_t(std::strtoul(line.c_str() + key.size(), nullptr, 8));
    return mode_t(077);
  }();
  return mask;
}

void sweepAside(const std::string& folder) {
  if (isFirstTime(folder)) sweepAsideAgain(folder);
}

void sweepAsideAgain(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::directory_iterator it(folder.empty() ? "." : folder, error);
  for (const fs::directory_iterator end; !error && it != end; it.increment(error))
    if (isAsideName(it->path().filename().string())) removeIfLeft(it->path().string());
}

Result<FolderAside> FolderAside::in(const std::string& parent) {
  sweepAside(parent);
  std::string path = (std::filesystem::path(parent) / asideName).string();
  if (!::mkdtemp(path.data())) return Error{std::strerror(errno)};
  FolderAside made(path, ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!claimAside(made.descriptor_)) return in(parent);
  return made;
}

FolderAside::~FolderAside() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  if (descriptor_ >= 0) ::close(descriptor_);
}

Status FolderAside::become(const std::string& target) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::permissions(path_, fs::perms(0777 & ~rightsKept()), error);
  fs::rename(path_, target, error);
  if (error) return Error{error.message()};
  path_.clear();
  return {};
}

}  // namespace volumen
