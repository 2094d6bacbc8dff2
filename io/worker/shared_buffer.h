#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "io/worker/channel.h"

namespace volumen::worker {

/// Memory shared by the program and one worker: two slots through which answers pass in turn, the number of
/// finished steps of a request, and how much of a picture is read. The worker may write to it at any time, so
/// readers copy first and check the copy.
class SharedBuffer {
 public:
  static constexpr std::size_t slotBytes = 512 << 10, slots = 2;

  /// Returns new memory, sealed at its size, or an invalid buffer. `descriptor` is for the worker.
  static SharedBuffer make(Descriptor& descriptor);
  /// Maps the memory of the other process.
  static SharedBuffer of(int descriptor);

  SharedBuffer() = default;
  SharedBuffer(SharedBuffer&& other) noexcept : memory_(std::exchange(other.memory_, nullptr)) {}
  SharedBuffer& operator=(SharedBuffer&& other) noexcept {
    std::swap(memory_, other.memory_);
    return *this;
  }
  ~SharedBuffer();

  explicit operator bool() const { return memory_ != nullptr; }
  std::uint8_t* slot(std::uint64_t n) const { return memory_ + headBytes + n % slots * slotBytes; }
  std::atomic<std::uint32_t>& steps() const {
    return *reinterpret_cast<std::atomic<std::uint32_t>*>(memory_);
  }
  /// Bytes of the requested picture that are read, and its size in bytes (0: unknown).
  std::atomic<std::uint64_t>& readBytes() const { return bytesAt(8); }
  std::atomic<std::uint64_t>& pictureBytes() const { return bytesAt(16); }

 private:
  std::atomic<std::uint64_t>& bytesAt(std::size_t offset) const {
    return *reinterpret_cast<std::atomic<std::uint64_t>*>(memory_ + offset);
  }

  static constexpr std::size_t headBytes = 4096;
  static constexpr std::size_t allBytes = headBytes + slots * slotBytes;
  std::uint8_t* memory_ = nullptr;
};

}  // namespace volumen::worker
