#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace volumen {

/// Asks the system for huge pages behind memory that nothing has touched yet: first touch of small pages
/// costs more than the work on them. Only a wish: without them the memory is as good.
void wantHugePages(void* memory, std::size_t bytes);

/// Memory behind huge pages where it is large.
void* allocateLarge(std::size_t bytes);
void freeLarge(void* memory) noexcept;

/// So many zeros, behind huge pages where they are many: for the values of a volume.
template <class T>
std::vector<T> zeros(std::size_t count) {
  std::vector<T> values;
  values.reserve(count);
  wantHugePages(values.data(), count * sizeof(T));
  values.resize(count);
  return values;
}

/// How many elements apart rows of `count` elements begin, each of so many bytes. Rows of a multiple of 2048
/// bytes get 32 more: those next to each other would fall into one or two sets of a cache and push one
/// another out (512 voxels of 8 bytes all into one).
constexpr int rowStride(int count, int elementBytes) {
  return count + (count * elementBytes % 2048 == 0 ? 32 / elementBytes : 0);
}

/// A fixed number of values, not initialised, aligned to 64 bytes, with 64 readable bytes behind the last:
/// vector loads and gathers of the last value may read past it. For large data that are written once, on all
/// cores.
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
