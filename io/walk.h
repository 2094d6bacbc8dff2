#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// The regular files under a path, and the entries that could not be looked at, each with its reason.
struct FoundFiles {
  std::vector<std::string>
      files;  ///< sorted by folder and name; each file once, however many links lead to it
  std::vector<std::pair<std::string, std::string>> unreadable;  ///< path, reason
};

/// Finds all regular files under `path` (itself, where it is one). Symbolic links are followed, loops end
/// (each folder and file once, by device and inode); FIFOs, sockets and devices are left out. An Error where
/// there is no such path.
Result<FoundFiles> findFiles(const std::string& path, const CancelToken& cancel);

/// An open regular file that is read at given places.
class RegularFile {
 public:
  /// Opens without ever blocking (FIFO, device) and checks that it is a regular file.
  static Result<RegularFile> open(const std::string& path);
  RegularFile(RegularFile&& other) noexcept : fd_(std::exchange(other.fd_, -1)), size_(other.size_) {}
  RegularFile& operator=(RegularFile&&) = delete;
  ~RegularFile();

  std::uint64_t size() const { return size_; }
  /// The `length` bytes at `offset`, exactly.
  Result<std::vector<std::uint8_t>> read(std::uint64_t offset, std::uint64_t length) const;
  /// Extends `bytes`, which hold the beginning of the file, to its first `length` bytes (or all of it).
  Status readUpTo(std::vector<std::uint8_t>& bytes, std::uint64_t length) const;

 private:
  Status fill(std::uint64_t offset, std::span<std::uint8_t> out) const;
  RegularFile(int fd, std::uint64_t size) : fd_(fd), size_(size) {}
  int fd_;
  std::uint64_t size_;
};

}  // namespace volumen
