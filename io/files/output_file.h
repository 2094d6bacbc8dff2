#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "viewer/volume/result.h"

namespace volumen {

/// A file that appears whole or not at all: it is written beside its final path and renamed by commit().
/// Without commit() (an error, a cancelled command) nothing is left. The name may be any bytes. An existing
/// file is replaced; symbolic links stay, and their target is written.
class OutputFile {
 public:
  /// Creates the temporary file. The Error ("Cannot write PATH: no such folder.") also tells whether the path
  /// can be written at all: discard the file without commit() to test only that.
  static Result<OutputFile> create(const std::string& path);
  OutputFile(OutputFile&&) noexcept;
  ~OutputFile();

  Status write(const void* bytes, std::size_t count);
  Status write(std::string_view text) { return write(text.data(), text.size()); }
  /// Returns the path of the temporary file, for libraries that open it by its name in place of write().
  const std::string& asidePath() const;
  /// Compresses all following bytes as one gzip member.
  Status startGzip();
  /// Completes the file and renames it to its path.
  Status commit();
  /// Completes the file and renames it to another path on the same disk, which is known only now, unless
  /// something has that name: never replaces it, whoever made it meanwhile. Returns whether it was renamed;
  /// if not, the temporary file stays as long as this object.
  Result<bool> commitAsNew(const std::string& path);

 private:
  struct State;
  explicit OutputFile(std::unique_ptr<State> state);
  Status fail(const std::string& why) const;
  Status deflateAll(int flush);
  Status complete();
  std::unique_ptr<State> state_;
};

/// Writes a file of these bytes. The Error names it.
Status writeWholeFile(const std::string& path, std::string_view bytes);

}  // namespace volumen
