#include "io/worker/batches.h"

namespace volumen::worker {

Request headersOf(std::vector<std::string> files, const CancelToken& cancel) {
  constexpr std::uint64_t mebibyte = 1 << 20;
  Request request{.files = std::move(files), .needBytes = 32 * mebibyte, .mostBytes = 256 * mebibyte};
  request.steps = std::uint32_t(request.files.size());
  request.cancel = &cancel;
  return request;
}

}  // namespace volumen::worker
