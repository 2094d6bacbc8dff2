#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "viewer/volume/result.h"

namespace volumen {

/// A file that appears whole or not at all: written aside in the same folder, renamed by commit(). Without
/// commit() (an error, a cancelled command) nothing is left. Its name may be any bytes; what stands there
/// already is replaced where it is a file. Symbolic links stay: what they lead to is written.
class OutputFile {
 public:
  /// The Error, "Cannot write PATH: no such folder.", also says where it cannot be made at all; whoever asks
  /// only that lets it go without commit().
  static Result<OutputFile> create(const std::string& path);
  OutputFile(OutputFile&&) noexcept;
  ~OutputFile();

  Status write(const void* bytes, std::size_t count);
  Status write(std::string_view text) { return write(text.data(), text.size()); }
  /// What is written from here on is compressed, as one gzip member.
  Status startGzip();
  /// Ends the file and gives it its name.
  Status commit();

 private:
  struct State;
  explicit OutputFile(std::unique_ptr<State> state);
  Status fail(const std::string& why) const;
  Status deflateAll(int flush);
  std::unique_ptr<State> state_;
};

/// A file of these bytes. The Error names it.
Status writeWholeFile(const std::string& path, std::string_view bytes);

}  // namespace volumen
