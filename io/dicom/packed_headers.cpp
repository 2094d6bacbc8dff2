#include "io/dicom/packed_headers.h"

#include <algorithm>

#include "io/worker/dicom_fields.h"
#include "io/worker/worker.h"

namespace volumen::dicom {

namespace {

using OwnBytes = std::vector<std::uint8_t>;

// Writes seven bits per byte, lowest first. All bytes but the last have the high bit set.
void putNumber(std::size_t number, OwnBytes& to) {
  for (; number > 127; number >>= 7) to.push_back(std::uint8_t(number | 128));
  to.push_back(std::uint8_t(number));
}

std::size_t takeNumber(const OwnBytes& from, std::size_t& at) {
  std::size_t number = 0;
  for (int shift = 0;; shift += 7) {
    const std::uint8_t byte = from[at++];
    number |= std::size_t(byte & 127) << shift;
    if (byte < 128) return number;
  }
}

// Returns the runs in which `bytes` differs from `base` of the same length. Each run is the number of equal
// bytes before it, its length, and its bytes.
OwnBytes differences(const OwnBytes& bytes, const OwnBytes& base) {
  constexpr std::size_t shortest = 3;  // number of equal bytes that ends a run
  OwnBytes out;
  for (std::size_t done = 0;;) {
    const auto first =
        std::mismatch(bytes.begin() + std::ptrdiff_t(done), bytes.end(), base.begin() + std::ptrdiff_t(done));
    const std::size_t begin = std::size_t(first.first - bytes.begin());
    if (begin == bytes.size()) return out;
    std::size_t end = begin + 1;
    for (std::size_t alike = 0; end + alike < bytes.size() && alike < shortest;)
      if (bytes[end + alike] == base[end + alike])
        ++alike;
      else
        end += alike + 1, alike = 0;
    putNumber(begin - done, out);
    putNumber(end - begin, out);
    out.insert(out.end(), bytes.begin() + std::ptrdiff_t(begin), bytes.begin() + std::ptrdiff_t(end));
    done = end;
  }
}

OwnBytes changed(OwnBytes base, const OwnBytes& differences) {
  std::size_t to = 0;
  for (std::size_t at = 0; at < differences.size();) {
    to += takeNumber(differences, at);
    const std::size_t count = takeNumber(differences, at);
    std::copy_n(differences.begin() + std::ptrdiff_t(at), count, base.begin() + std::ptrdiff_t(to));
    at += count, to += count;
  }
  return base;
}

}  // namespace

void PackedHeaders::add(const FileHeader& header) {
  worker::MemoryWriter writer;
  writer.write(header);
  OwnBytes bytes = std::move(writer).take();
  Packed& packed = packed_.emplace_back();
  bytes_ += sizeof(Packed);
  const auto [known, isNew] =
      baseOf_.try_emplace({header.seriesUid, bytes.size()}, std::uint32_t(bases_.size()));
  packed.base = known->second;
  if (isNew) {
    bytes.shrink_to_fit();
    bytes_ += bytes.size();
    bases_.push_back(std::move(bytes));
  } else {
    const OwnBytes others = differences(bytes, bases_[packed.base]);
    packed.others.assign(others.begin(), others.end());
    bytes_ += packed.others.size();
  }
  // Headers from workers were read from bytes already. Others may hold non-finite numbers, which cannot be
  // read.
  if (worker::isolating()) return;
  const OwnBytes all = changed(bases_[packed.base], packed.others);
  worker::MemoryReader reader(all);
  FileHeader read;
  reader(read);
  if (!reader.ok()) packed.whole = std::make_shared<const FileHeader>(header);
}

FileHeader PackedHeaders::at(std::size_t n) const {
  const Packed& packed = packed_[n];
  if (packed.whole) return *packed.whole;
  const OwnBytes bytes = changed(bases_[packed.base], packed.others);
  worker::MemoryReader reader(bytes);
  FileHeader header;
  reader(header);
  return header;
}

}  // namespace volumen::dicom
