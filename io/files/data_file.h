#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "io/regular_file.h"
#include "viewer/volume/result.h"

namespace volumen {

/// A regular file that holds headers or samples, open for reading; its errors name it.
class DataFile {
 public:
  static Result<DataFile> open(const std::string& path);

  std::uint64_t size() const { return file_->size(); }  ///< bytes, when it was opened
  const std::string& path() const { return path_; }

  /// Reads up to `count` bytes from byte `offset` on; returns how many: fewer only at the end of the file. An
  /// Error where the device fails.
  Result<std::size_t> readAt(std::uint64_t offset, void* to, std::size_t count) const;

 private:
  DataFile(std::shared_ptr<const RegularFile> file, std::string path)
      : file_(std::move(file)), path_(std::move(path)) {}
  std::shared_ptr<const RegularFile> file_;  // closed by the last copy
  std::string path_;
};

/// The first bytes of a file, at most `count`.
Result<std::string> readHead(const std::string& path, std::size_t count);

/// The path of `name`, which a header in `headerPath` refers to. Files are untrusted: refused are names that
/// are empty or absolute, that lead out of the header's folder (also through a link) or to the header itself,
/// and what is no regular file.
Result<std::string> resolveBeside(const std::string& headerPath, const std::string& name);

}  // namespace volumen
