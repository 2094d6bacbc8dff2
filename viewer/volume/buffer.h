#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace volumen {

void expectAvailable(std::uint64_t bytes);  // available_memory.h

/// Requests huge pages for untouched memory: the first touch of small pages costs more than the work on them.
/// Memory remains usable if the system declines.
void wantHugePages(void* memory, std::size_t bytes);

/// Allocates memory with huge pages if it is large. Throws std::bad_alloc if it is not available
/// (expectAvailable).
void* allocateLarge(std::size_t bytes);
void freeLarge(void* memory) noexcept;

/// Returns `count` zeros for the values of a volume, with huge pages if they are many. Throws
/// std::bad_alloc too.
template <class T>
std::vector<T> zeros(std::size_t count) {
  std::vector<T> values;
  expectAvailable(count * sizeof(T));
  values.reserve(count);
  wantHugePages(values.data(), count * sizeof(T));
  values.resize(count);
  return values;
}

/// Returns the distance between rows of `count` elements of `elementBytes` each, in elements. Multiples of
/// 2048 bytes get 32 more: neighbouring rows would otherwise share one or two cache sets and evict each other
/// (all into one for 512 voxels of 8 bytes).
constexpr int rowStride(int count, int elementBytes) {
  return count + (count * elementBytes % 2048 == 0 ? 32 / elementBytes : 0);
}

/// A fixed number of uninitialised values, aligned to 64 bytes, with 64 readable bytes after the last one:
/// vector loads and gathers may read past it. For large data written once, on all cores.
template <class T>
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(std::size_t size)
      : size_(size), data_(static_cast<T*>(allocateLarge(size * sizeof(T) + 64))) {}

  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(T); }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t n) { return data_.get()[n]; }
  const T& operator[](std::size_t n) const { return data_.get()[n]; }

 private:
  struct Free {
    void operator()(T* p) const { freeLarge(p); }
  };
  std::size_t size_ = 0;
  std::unique_ptr<T, Free> data_;
};

}  // namespace volumen
