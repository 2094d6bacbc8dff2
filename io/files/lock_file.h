#pragma once

#include <optional>
#include <string>
#include <utility>

namespace volumen {

/// A lock file that one program holds at a time. The system frees it however the program ends.
class LockFile {
 public:
  /// Returns nothing if another program holds the lock or the file cannot be created.
  static std::optional<LockFile> take(const std::string& path);
  LockFile(LockFile&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  LockFile& operator=(LockFile&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~LockFile();

 private:
  explicit LockFile(int fd) : fd_(fd) {}
  int fd_;
};

}  // namespace volumen
