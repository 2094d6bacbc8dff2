#include "viewer/volume/buffer.h"

#include <sys/mman.h>

#include <cstdlib>
#include <cstring>

namespace volumen {

void* allocateLarge(std::size_t bytes) {
  constexpr std::size_t hugePage = std::size_t(2) << 20;
  const bool large = bytes >= 2 * hugePage;
  const std::size_t alignment = large ? hugePage : 64;
  const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, rounded);
  if (!memory) throw std::bad_alloc();
  // Only a wish: without huge pages the memory is as good, only slower to touch.
  if (large) madvise(memory, rounded, MADV_HUGEPAGE);
  std::memset(static_cast<char*>(memory) + bytes - 64, 0, 64);
  return memory;
}

void freeLarge(void* memory) noexcept { std::free(memory); }

}  // namespace volumen
