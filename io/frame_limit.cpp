#include "io/frame_limit.h"

#include <atomic>

namespace volumen {

namespace {
std::atomic<std::uint64_t> limit = std::uint64_t(1) << 28;
}

std::uint64_t framePixelLimit() { return limit; }

std::string framePixelLimitText() { return std::to_string(limit / 1'000'000) + " million pixels"; }

void setFramePixelLimit(std::uint64_t pixels) { limit = pixels; }

}  // namespace volumen
