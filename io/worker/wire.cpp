#include "io/worker/wire.h"

#include <algorithm>

namespace volumen::worker {

void Wire::bytes(void* data, std::size_t count) {
  auto* place = static_cast<std::uint8_t*>(data);
  while (count > 0) {
    if (ok_ && at_ == end_ && !nextPiece()) ok_ = false;
    if (!ok_) {
      if (reading_) std::memset(place, 0, count);
      return;
    }
    const std::size_t part = std::min(count, std::size_t(end_ - at_));
    if (reading_)
      std::memcpy(place, at_, part);
    else
      std::memcpy(at_, place, part);
    at_ += part, place += part, count -= part;
  }
}

bool MemoryWriter::nextPiece() {
  const std::size_t used = bytes_.size();
  bytes_.resize(std::max<std::size_t>(256, 2 * used));
  at_ = bytes_.data() + used;
  end_ = bytes_.data() + bytes_.size();
  return true;
}

std::vector<std::uint8_t> MemoryWriter::take() && {
  bytes_.resize(bytes_.size() - std::size_t(end_ - at_));
  return std::move(bytes_);
}

MemoryReader::MemoryReader(std::span<const std::uint8_t> bytes) : Wire(true) {
  at_ = const_cast<std::uint8_t*>(bytes.data());
  end_ = at_ + bytes.size();
}

}  // namespace volumen::worker
