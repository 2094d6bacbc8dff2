#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "io/regular_file.h"
#include "viewer/volume/result.h"

namespace volumen {

/// A regular file with headers or samples, open for reading. Its errors name it.
class DataFile {
 public:
  static Result<DataFile> open(const std::string& path);

  std::uint64_t size() const { return file_->size(); }  ///< size in bytes when it was opened
  const std::string& path() const { return path_; }

  /// Reads up to `count` bytes from byte `offset` on and returns their number; fewer only at the end of the
  /// file. The Error: the device fails.
  Result<std::size_t> readAt(std::uint64_t offset, void* to, std::size_t count) const;

 private:
  DataFile(std::shared_ptr<const RegularFile> file, std::string path)
      : file_(std::move(file)), path_(std::move(path)) {}
  std::shared_ptr<const RegularFile> file_;  // closed by the last copy
  std::string path_;
};

/// Returns the first bytes of a file, at most `count`.
Result<std::string> readHead(const std::string& path, std::size_t count);

/// Returns the path of `name`, to which a header in `headerPath` refers. Files are untrusted. The Error:
/// `name` is empty, absolute, the header itself, outside its folder (also through a link), or not a regular
/// file.
Result<std::string> resolveBeside(const std::string& headerPath, const std::string& name);

}  // namespace volumen
