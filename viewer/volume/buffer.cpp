#include "viewer/volume/buffer.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "viewer/volume/available_memory.h"

namespace volumen {

namespace {
constexpr std::size_t hugePage = std::size_t(2) << 20;
}

void wantHugePages(void* memory, std::size_t bytes) {
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + hugePage - 1) / hugePage * hugePage;
  const std::uintptr_t last = (begin + bytes) / hugePage * hugePage;
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

void* allocateLarge(std::size_t bytes) {
  const std::size_t alignment = bytes >= 2 * hugePage ? hugePage : 64;
  const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
  expectAvailable(rounded);
  void* memory = std::aligned_alloc(alignment, rounded);
  if (!memory) throw std::bad_alloc();
  wantHugePages(memory, rounded);
  std::memset(static_cast<char*>(memory) + bytes - 64, 0, 64);
  return memory;
}

void freeLarge(void* memory) noexcept { std::free(memory); }

}  // namespace volumen
