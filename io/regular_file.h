#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Error of RegularFile::open() if this process or the system has no free descriptor.
inline constexpr const char* tooManyOpen = "too many files are open at once: allow more (ulimit -n)";

/// An open regular file with random access. Errors hold only the reason: the caller names the file.
class RegularFile {
 public:
  /// Opens without ever blocking (FIFO, device) and checks that the file is regular. For a worker (io/worker)
  /// the program opens it.
  static Result<RegularFile> open(const std::string& path);
  RegularFile(RegularFile&& other) noexcept : fd_(std::exchange(other.fd_, -1)), size_(other.size_) {}
  RegularFile& operator=(RegularFile&&) = delete;
  ~RegularFile();

  std::uint64_t size() const { return size_; }
  /// Returns the descriptor; the caller closes it.
  int release() && { return std::exchange(fd_, -1); }
  /// Reads up to `count` bytes from byte `offset` on and returns their number; fewer only at the end of the
  /// file.
  Result<std::size_t> readAt(std::uint64_t offset, void* to, std::size_t count) const;
  /// Returns exactly `length` bytes from `offset` on.
  Result<std::vector<std::uint8_t>> read(std::uint64_t offset, std::uint64_t length) const;
  /// Extends `bytes`, the beginning of the file, to its first `length` bytes (or all of it).
  Status readUpTo(std::vector<std::uint8_t>& bytes, std::uint64_t length) const;

 private:
  Status readAll(std::uint64_t offset, std::span<std::uint8_t> out) const;
  RegularFile(int fd, std::uint64_t size) : fd_(fd), size_(size) {}
  int fd_;
  std::uint64_t size_;
};

/// Returns the whole text of a file of up to `mostBytes`. `what` says what it should hold, "a recipe". The
/// Error is a sentence that names the file.
Result<std::string> wholeText(const std::string& path, std::uint64_t mostBytes, const char* what);

/// Returns the last part of a path.
std::string fileName(const std::string& path);

}  // namespace volumen
