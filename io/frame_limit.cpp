#include "io/frame_limit.h"

#include <atomic>

namespace volumen {

namespace {
std::atomic<std::uint64_t> limit = std::uint64_t(1) << 28;
}

std::uint64_t framePixelLimit() { return limit; }

void setFramePixelLimit(std::uint64_t pixels) { limit = pixels; }

}  // namespace volumen
