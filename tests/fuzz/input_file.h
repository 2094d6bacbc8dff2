#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace volumen::fuzz {

/// A file in memory that holds one input after another, under a name with the extension of its format.
class InputFile {
 public:
  explicit InputFile(const std::string& ending)
      : path_("/dev/shm/volumen-fuzz-" + std::to_string(getpid()) + ending) {}
  ~InputFile() { std::remove(path_.c_str()); }

  const std::string& holding(const std::uint8_t* bytes, std::size_t size) {
    std::FILE* file = std::fopen(path_.c_str(), "wb");
    if (!file || std::fwrite(bytes, 1, size, file) != size || std::fclose(file) != 0) std::abort();
    return path_;
  }

 private:
  std::string path_;
};

/// Inputs whose pictures have more pixels only cost time.
inline constexpr std::int64_t mostPixels = 1 << 20;

}  // namespace volumen::fuzz
