#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Why RegularFile::open() opens nothing where this process, or the system, has no descriptor left.
inline constexpr const char* tooManyOpen = "too many files are open at once: allow more (ulimit -n)";

/// An open regular file that is read at given places. Errors give the reason alone: who opened it names it.
class RegularFile {
 public:
  /// Opens without ever blocking (FIFO, device) and checks that it is a regular file. In a worker
  /// (io/worker) the program opens it.
  static Result<RegularFile> open(const std::string& path);
  RegularFile(RegularFile&& other) noexcept : fd_(std::exchange(other.fd_, -1)), size_(other.size_) {}
  RegularFile& operator=(RegularFile&&) = delete;
  ~RegularFile();

  std::uint64_t size() const { return size_; }
  /// Its descriptor, which whoever asks for it closes.
  int release() && { return std::exchange(fd_, -1); }
  /// Reads up to `count` bytes from byte `offset` on; returns how many: fewer only at the end of the file.
  Result<std::size_t> readAt(std::uint64_t offset, void* to, std::size_t count) const;
  /// The `length` bytes at `offset`, exactly.
  Result<std::vector<std::uint8_t>> read(std::uint64_t offset, std::uint64_t length) const;
  /// Extends `bytes`, which hold the beginning of the file, to its first `length` bytes (or all of it).
  Status readUpTo(std::vector<std::uint8_t>& bytes, std::uint64_t length) const;

 private:
  Status readAll(std::uint64_t offset, std::span<std::uint8_t> out) const;
  RegularFile(int fd, std::uint64_t size) : fd_(fd), size_(size) {}
  int fd_;
  std::uint64_t size_;
};

/// The last part of a path.
std::string fileName(const std::string& path);

}  // namespace volumen
