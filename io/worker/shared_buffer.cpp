#include "io/worker/shared_buffer.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace volumen::worker {

SharedBuffer SharedBuffer::make(Descriptor& descriptor) {
  descriptor = Descriptor(memfd_create("volumen answers", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  // Shrinking the memory would end the process that reads from it.
  if (!descriptor || ftruncate(descriptor.get(), off_t(allBytes)) != 0 ||
      fcntl(descriptor.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0)
    return {};
  return of(descriptor.get());
}

SharedBuffer SharedBuffer::of(int descriptor) {
  SharedBuffer buffer;
  void* memory = mmap(nullptr, allBytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (memory != MAP_FAILED) buffer.memory_ = static_cast<std::uint8_t*>(memory);
  return buffer;
}

SharedBuffer::~SharedBuffer() {
  if (memory_) munmap(memory_, allBytes);
}

}  // namespace volumen::worker
