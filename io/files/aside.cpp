#include "io/files/aside.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>
#include <string_view>

namespace volumen {
namespace {

bool isFirstTime(const std::string& folder) {
  static std::mutex mutex;
  static std::set<std::string> looked;
  const std::scoped_lock one(mutex);
  return looked.insert(folder).second;
}

/// Whether it is this user's, and whoever wrote it has ended: with that its lock went.
bool isLeft(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  if (fd < 0) return false;
  struct stat status {};
  const bool left =
      ::fstat(fd, &status) == 0 && status.st_uid == ::geteuid() && ::flock(fd, LOCK_EX | LOCK_NB) == 0;
  ::close(fd);
  return left;
}

}  // namespace

void claimAside(int descriptor) { (void)::flock(descriptor, LOCK_EX | LOCK_NB); }

mode_t rightsKept() {
  static const mode_t mask = [] {
    const mode_t now = ::umask(0);
    ::umask(now);
    return now;
  }();
  return mask;
}

void sweepAside(const std::string& folder) {
  namespace fs = std::filesystem;
  constexpr std::string_view prefix = ".volumen-";
  if (!isFirstTime(folder)) return;
  std::error_code error;
  fs::directory_iterator it(folder.empty() ? "." : folder, error);
  for (const fs::directory_iterator end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    std::error_code ignored;
    if (name.starts_with(prefix) && name.size() == std::strlen(asideName) && isLeft(it->path().string()))
      fs::remove_all(it->path(), ignored);
  }
}

}  // namespace volumen
