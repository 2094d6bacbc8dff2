#pragma once

#include <optional>
#include <string>
#include <utility>

namespace volumen {

/// A file that only one program holds at a time. However a program ends, the system then frees what it held.
class LockFile {
 public:
  /// None where another holds it, or it cannot be made.
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
