#include <algorithm>

#include "io/dicom/decode.h"

namespace volumen::dicom {
namespace {

/// Decodes PackBits (PS3.5 G.3.2) to every `stride`-th byte of `out`, `count` bytes from `first` on.
bool unpackBits(Bytes in, std::vector<std::uint8_t>& out, std::size_t first, std::size_t stride,
                std::size_t count) {
  std::size_t at = 0, done = 0;
  while (done < count && at + 1 < in.size()) {
    const int control = std::int8_t(in[at++]);
    if (control == -128) continue;
    const bool repeats = control < 0;
    const std::size_t length = std::size_t(repeats ? 1 - control : 1 + control);
    if (!repeats && at + length > in.size()) return false;
    for (std::size_t n = 0; n < std::min(length, count - done); ++n)
      out[first + (done + n) * stride] = in[repeats ? at : at + n];
    done += std::min(length, count - done);
    at += repeats ? 1 : length;
  }
  return done == count;
}

}  // namespace

Result<std::vector<std::uint8_t>> decodeRle(const PixelFormat& format, Bytes bytes) {
  constexpr std::size_t headerSize = 64;
  const std::size_t width = std::size_t(format.bitsAllocated / 8);
  const std::size_t planes = width * std::size_t(format.samples);
  if (bytes.size() < headerSize) return Error{"its RLE header is cut off"};
  if (numberAt<std::uint32_t>(bytes, 0, false) != planes)
    return Error{"its RLE header has the wrong number of segments"};
  // Two bytes of code give at most 128 bytes of picture.
  if (bytes.size() < format.frameBytes() / 64) return Error{"its RLE data is too short for its picture"};
  std::vector<std::uint8_t> out(format.frameBytes());
  for (std::size_t plane = 0; plane < planes; ++plane) {
    const std::size_t begin = numberAt<std::uint32_t>(bytes, 4 + 4 * plane, false);
    const std::size_t end =
        plane + 1 < planes ? numberAt<std::uint32_t>(bytes, 8 + 4 * plane, false) : bytes.size();
    if (begin < headerSize || begin > end || end > bytes.size())
      return Error{"its RLE header points outside its data"};
    // The first segment of each colour holds the most significant bytes (PS3.5 G.2).
    const std::size_t first = plane / width * width + width - 1 - plane % width;
    if (!unpackBits(bytes.subspan(begin, end - begin), out, first, planes, format.framePixels()))
      return Error{"its RLE data is cut off or damaged"};
  }
  return out;
}

}  // namespace volumen::dicom
