#include "io/dicom/inflate.h"

#include <zlib.h>

#include <algorithm>

namespace volumen::dicom {
namespace {

constexpr std::size_t mebibyte = std::size_t(1) << 20;

/// A zlib stream that is always closed.
struct Inflater {
  z_stream stream{};
  bool ready;
  explicit Inflater(int windowBits) : ready(inflateInit2(&stream, windowBits) == Z_OK) {}
  Inflater(const Inflater&) = delete;
  ~Inflater() {
    if (ready) inflateEnd(&stream);
  }
};

/// Returns whether a stream begins with a zlib (RFC 1950) or gzip (RFC 1952) header. A raw stream could match
/// only with bits that no encoder sets.
bool isWrapped(Bytes deflated) {
  constexpr unsigned deflate = 8, check = 31;
  if (deflated.size() < 2) return false;
  const unsigned first = deflated[0], second = deflated[1];
  return (first == 0x1f && second == 0x8b) ||
         ((first & 0xf) == deflate && first >> 4 <= 7 && (first << 8 | second) % check == 0);
}

}  // namespace

std::size_t mostInflated(std::size_t deflatedBytes) {
  if (deflatedBytes > 512 * mebibyte) return 512 * mebibyte;
  return std::min(512 * mebibyte, std::max(64 * mebibyte, 200 * deflatedBytes));
}

Result<std::vector<std::uint8_t>> inflateAll(Bytes deflated) {
  const std::size_t limit = mostInflated(deflated.size());
  if (deflated.size() > 512 * mebibyte) return Error{"the deflated data set is larger than 512 MiB"};
  constexpr int detect = 32;
  Inflater inflater(isWrapped(deflated) ? MAX_WBITS + detect : -MAX_WBITS);
  if (!inflater.ready) return Error{"zlib could not be started"};
  z_stream& z = inflater.stream;
  z.next_in = const_cast<Bytef*>(deflated.data());
  z.avail_in = uInt(deflated.size());
  std::vector<std::uint8_t> out;
  int state = Z_OK;
  while (state == Z_OK) {
    const std::size_t done = out.size();
    if (done > limit)
      return Error{"the deflated data set grows beyond " + std::to_string(limit / mebibyte) + " MiB"};
    out.resize(done + std::clamp(done, mebibyte / 4, 16 * mebibyte));
    z.next_out = out.data() + done;
    z.avail_out = uInt(out.size() - done);
    state = ::inflate(&z, Z_NO_FLUSH);
    out.resize(out.size() - z.avail_out);
    if (state == Z_OK && z.avail_in == 0 && z.avail_out != 0) state = Z_BUF_ERROR;
  }
  if (state != Z_STREAM_END) return Error{"the deflated data set is damaged or cut off"};
  return out;
}

}  // namespace volumen::dicom
