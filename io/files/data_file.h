#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// A regular file that holds headers or samples, open for reading. Pipes, devices and folders are refused
/// without being waited for.
class DataFile {
 public:
  static Result<DataFile> open(const std::string& path);

  std::uint64_t size() const { return size_; }  ///< bytes, when it was opened
  const std::string& path() const { return path_; }

  /// Reads up to `count` bytes from byte `offset` on; returns how many: fewer only at the end of the file. An
  /// Error where the device fails.
  Result<std::size_t> readAt(std::uint64_t offset, void* to, std::size_t count) const;

 private:
  DataFile(std::shared_ptr<const int> descriptor, std::uint64_t size, std::string path)
      : descriptor_(std::move(descriptor)), size_(size), path_(std::move(path)) {}
  std::shared_ptr<const int> descriptor_;  // closed by the last copy
  std::uint64_t size_ = 0;
  std::string path_;
};

/// The first bytes of a file, at most `count`.
Result<std::string> readHead(const std::string& path, std::size_t count);

/// The path of `name`, which a header in `headerPath` refers to. Files are untrusted: refused are names that
/// are empty or absolute, or that lead out of the header's folder (also through a link), and what is no
/// regular file.
Result<std::string> resolveBeside(const std::string& headerPath, const std::string& name);

}  // namespace volumen
