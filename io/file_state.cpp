#include "io/file_state.h"

#include <sys/stat.h>

#include <algorithm>
#include <ctime>

namespace volumen {
namespace {

constexpr std::int64_t secondNs = 1'000'000'000;

std::int64_t nanoseconds(const timespec& t) { return t.tv_sec * secondNs + t.tv_nsec; }

}  // namespace

std::optional<FileState> fileState(const std::string& path) {
  struct stat s {};
  if (::stat(path.c_str(), &s) != 0) return {};
  return FileState{s.st_size, nanoseconds(s.st_mtim), nanoseconds(s.st_ctim), std::int64_t(s.st_ino),
                   std::int64_t(s.st_dev)};
}

bool mayChangeUnseen(const FileState& state) {
  return std::time(nullptr) * secondNs - std::max(state.modifiedNs, state.changedNs) < 3 * secondNs;
}

}  // namespace volumen
