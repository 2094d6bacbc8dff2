#include "io/worker/batches.h"

#include <filesystem>

namespace volumen::worker {

Request headersOf(std::vector<std::string> files, const CancelToken& cancel) {
  constexpr std::uint64_t mebibyte = 1 << 20, mostNeed = 32 * mebibyte, mostAnswer = 256 * mebibyte;
  std::uint64_t all = 0;
  for (const std::string& file : files) {
    std::error_code missing;
    if (const auto size = std::filesystem::file_size(file, missing); !missing)
      all = std::min(all + size, mostNeed);
  }
  Request request{.files = std::move(files), .needBytes = all, .cancel = &cancel};
  request.mostBytes = std::min(mebibyte + 64 * all, mostAnswer);
  request.steps = std::uint32_t(request.files.size());
  return request;
}

}  // namespace volumen::worker
