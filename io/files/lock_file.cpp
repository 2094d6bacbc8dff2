#include "io/files/lock_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace volumen {

std::optional<LockFile> LockFile::take(const std::string& path) {
  LockFile file(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (file.fd_ < 0 || flock(file.fd_, LOCK_EX | LOCK_NB) != 0) return {};
  return file;
}

LockFile::~LockFile() {
  if (fd_ >= 0) close(fd_);
}

}  // namespace volumen
