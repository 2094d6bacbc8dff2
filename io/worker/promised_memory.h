#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "viewer/volume/cancel.h"

namespace volumen::worker {

/// Memory promised to one call, for its worker and the program together. All running calls share one
/// limit, the memory that is available. Thread-safe.
class PromisedMemory {
 public:
  /// Returns a promise for a result of `needBytes`. Waits for other calls to end if it fits only without
  /// them. Returns none if it does not fit at all, or if cancelled meanwhile. Small results are not counted.
  static std::optional<PromisedMemory> of(std::uint64_t needBytes, const CancelToken* cancel);
  /// Returns the bytes that a worker and the program may take for a result.
  static std::uint64_t bytesFor(std::uint64_t needBytes) { return 3 * needBytes; }

  PromisedMemory(PromisedMemory&& other) noexcept : bytes_(std::exchange(other.bytes_, 0)) {}
  PromisedMemory& operator=(PromisedMemory&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~PromisedMemory();

 private:
  explicit PromisedMemory(std::uint64_t bytes) : bytes_(bytes) {}

  std::uint64_t bytes_;
};

}  // namespace volumen::worker
