#include "io/files/session_file.h"

#include <filesystem>

#include "io/regular_file.h"

namespace volumen {

namespace {
constexpr std::uint64_t mostSessionBytes = 8 << 20;
}

bool isSessionFile(const std::string& path) {
  std::error_code ignored;
  return path.ends_with(".volumen") && !std::filesystem::is_directory(path, ignored);
}

Result<std::string> sessionText(const std::string& path) {
  const auto file = RegularFile::open(path);
  if (!file) return Error{"Cannot read the session " + path + ": " + file.message() + "."};
  if (file->size() > mostSessionBytes) return Error{path + " is no session: it is larger than 8 MiB."};
  const auto bytes = file->read(0, file->size());
  if (!bytes) return Error{"Cannot read the session " + path + ": " + bytes.message() + "."};
  return std::string(bytes->begin(), bytes->end());
}

}  // namespace volumen
