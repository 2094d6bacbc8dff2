#include "io/dicom/codestream.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace volumen::dicom {
namespace {

constexpr int scanLimit = 100;
constexpr std::uint32_t tileLimit = 4096;

bool isFrameHeader(std::uint8_t marker) {
  return (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc) ||
         marker == 0xf7;
}

bool standsAlone(std::uint8_t marker) { return (marker >= 0xd0 && marker <= 0xd8) || marker == 0x01; }

/// Returns the fewest bytes that entropy coding needs for `samples` samples, as Huffman codes have at least
/// one bit. Lossless needs one bit a sample, sequential two a block of 64, progressive one. JPEG-LS has no
/// minimum.
std::uint64_t leastBytes(std::uint8_t frameMarker, std::uint64_t samples) {
  if (frameMarker == 0xf7) return 0;
  const int kind = frameMarker & 3;
  return samples / (kind == 3 ? 8 : kind == 2 ? 512 : 256);
}

/// Returns the position of the next marker from `at` on that is neither stuffing nor a restart marker.
std::size_t nextMarker(Bytes stream, std::size_t at) {
  for (; at + 1 < stream.size(); ++at) {
    const std::uint8_t second = stream[at + 1];
    // A byte below 0x80 is a stuffed zero, or begins with JPEG-LS's stuffed bit.
    if (stream[at] == 0xff && second >= 0x80 && second != 0xff && !(second >= 0xd0 && second <= 0xd7))
      return at;
  }
  return stream.size();
}

StreamInfo frameHeader(Bytes segment) {
  return {numberAt<std::uint16_t>(segment, 3, true), numberAt<std::uint16_t>(segment, 1, true), segment[5],
          segment[0], false};
}

/// Returns the colours that a frame header implies by names and sampling of its components.
JpegColours coloursOf(Bytes frameHeader) {
  constexpr std::size_t first = 6, each = 3;
  if (frameHeader.size() < first + 3 * each || frameHeader[first - 1] != 3) return JpegColours::unsaid;
  const auto name = [&](std::size_t n) { return frameHeader[first + n * each]; };
  const auto sampling = [&](std::size_t n) { return frameHeader[first + n * each + 1]; };
  if (name(0) == 'R' && name(1) == 'G' && name(2) == 'B') return JpegColours::rgb;
  const bool alike = sampling(0) == sampling(1) && sampling(0) == sampling(2);
  return alike ? JpegColours::unsaid : JpegColours::ybr;
}

}  // namespace

Result<StreamInfo> jpegInfo(Bytes stream) {
  if (stream.size() < 4 || stream[0] != 0xff || stream[1] != 0xd8)
    return Error{"its JPEG stream does not begin as one"};
  StreamInfo info;
  std::uint8_t frameMarker = 0;
  int scans = 0;
  std::size_t at = 2;
  while (at + 1 < stream.size()) {
    if (stream[at] != 0xff)
      return Error{"its JPEG stream is damaged (no marker at byte " + std::to_string(at) + ")"};
    const std::uint8_t marker = stream[at + 1];
    if (marker == 0xff) {
      ++at;  // fill byte
      continue;
    }
    if (marker == 0xd9) break;
    if (standsAlone(marker)) return Error{"its JPEG stream holds a marker that no picture needs"};
    if (at + 4 > stream.size()) return Error{"its JPEG stream is cut off"};
    const std::size_t length = numberAt<std::uint16_t>(stream, at + 2, true);
    if (length < 2 || at + 2 + length > stream.size()) return Error{"its JPEG stream is cut off"};
    if (isFrameHeader(marker)) {
      if (frameMarker || length < 8) return Error{"its JPEG stream has a damaged frame header"};
      frameMarker = marker;
      info = frameHeader(stream.subspan(at + 4, length - 2));
    }
    at += 2 + length;
    if (marker != 0xda) continue;
    if (++scans > scanLimit) return Error{"its JPEG stream has more than 100 scans"};
    at = nextMarker(stream, at);
  }
  if (!frameMarker || !scans) return Error{"its JPEG stream holds no picture"};
  if (stream.size() < leastBytes(frameMarker, std::uint64_t(info.columns) * std::uint64_t(info.rows)))
    return Error{"its JPEG stream is too short for its picture"};
  return info;
}

JpegColours jpegColours(Bytes stream) {
  constexpr std::uint8_t jfif = 0xe0, adobe = 0xee;
  bool isJfif = false;
  std::optional<int> transform;
  for (std::size_t at = 2; at + 4 <= stream.size() && stream[at] == 0xff;) {
    const std::uint8_t marker = stream[at + 1];
    const std::size_t length = numberAt<std::uint16_t>(stream, at + 2, true);
    if (length < 2 || length > stream.size() - at - 2) break;
    const Bytes segment = stream.subspan(at + 4, length - 2);
    const auto begins = [&](std::string_view text) {
      return segment.size() >= text.size() && std::equal(text.begin(), text.end(), segment.begin());
    };
    constexpr std::size_t adobeTransform = 11;
    if (marker == jfif && begins("JFIF")) isJfif = true;
    if (marker == adobe && begins("Adobe") && segment.size() > adobeTransform)
      transform = segment[adobeTransform];
    if (isFrameHeader(marker)) {
      if ((marker & 3) == 3) break;
      if (transform == 0) return JpegColours::rgb;
      return transform == 1 || isJfif ? JpegColours::ybr : coloursOf(segment);
    }
    at += 2 + length;
  }
  return JpegColours::unsaid;
}

namespace {

const char* syntaxOfJpeg(Bytes begin) {
  for (std::size_t at = 2; at + 4 <= begin.size() && begin[at] == 0xff;) {
    const std::uint8_t marker = begin[at + 1];
    if (marker == 0xf7) return "1.2.840.10008.1.2.4.80";
    if (isFrameHeader(marker) && (marker & 3) == 3) return "1.2.840.10008.1.2.4.57";
    if (isFrameHeader(marker) && (marker & 3) == 2) return "1.2.840.10008.1.2.4.55";
    if (isFrameHeader(marker)) return marker == 0xc0 ? "1.2.840.10008.1.2.4.50" : "1.2.840.10008.1.2.4.51";
    at += 2 + numberAt<std::uint16_t>(begin, at + 2, true);
  }
  return "";
}

/// Returns whether an RLE frame header (PS3.5 G.5) begins here: a segment count and ascending segment
/// offsets, the first right after the header.
bool isRleHeader(Bytes begin) {
  constexpr std::uint32_t headerBytes = 64, mostSegments = 15;
  if (begin.size() < headerBytes) return false;
  const auto field = [&](std::uint32_t n) { return numberAt<std::uint32_t>(begin, 4 * n, false); };
  const std::uint32_t segments = field(0);
  if (segments < 1 || segments > mostSegments || field(1) != headerBytes) return false;
  for (std::uint32_t n = 2; n <= mostSegments; ++n)
    if (n <= segments ? field(n) <= field(n - 1) : field(n) != 0) return false;
  return true;
}

}  // namespace

const char* syntaxOfStream(Bytes begin) {
  constexpr std::array<std::uint8_t, 3> jpeg{0xff, 0xd8, 0xff};
  constexpr std::array<std::uint8_t, 4> jpeg2000{0xff, 0x4f, 0xff, 0x51};
  constexpr std::array<std::uint8_t, 8> jp2{0, 0, 0, 12, 'j', 'P', ' ', ' '};
  const auto starts = [&](const auto& with) {
    return begin.size() >= with.size() && std::equal(with.begin(), with.end(), begin.begin());
  };
  if (starts(jpeg)) return syntaxOfJpeg(begin);
  if (starts(jpeg2000) || starts(jp2)) return "1.2.840.10008.1.2.4.91";
  return isRleHeader(begin) ? "1.2.840.10008.1.2.5" : "";
}

Bytes jpeg2000Stream(Bytes frame) {
  constexpr std::array<std::uint8_t, 4> start{0xff, 0x4f, 0xff, 0x51};  // SOC, SIZ
  const auto it = std::search(frame.begin(), frame.end(), start.begin(), start.end());
  return frame.subspan(std::size_t(it - frame.begin()));
}

Result<StreamInfo> jpeg2000Info(Bytes stream) {
  constexpr std::size_t least = 4 + 38 + 3;
  if (stream.size() < least) return Error{"its JPEG 2000 stream has no SIZ marker"};
  const auto field = [&](std::size_t offset) { return numberAt<std::uint32_t>(stream, offset, true); };
  const std::uint32_t right = field(8), bottom = field(12), left = field(16), top = field(20);
  const std::uint32_t tileWidth = field(24), tileHeight = field(28), tileLeft = field(32),
                      tileTop = field(36);
  if (right <= left || bottom <= top || right - left > 65535 || bottom - top > 65535 || !tileWidth ||
      !tileHeight || tileLeft > left || tileTop > top)
    return Error{"its JPEG 2000 stream has a damaged SIZ marker"};
  const std::uint64_t tiles = ((std::uint64_t(right) - tileLeft + tileWidth - 1) / tileWidth) *
                              ((std::uint64_t(bottom) - tileTop + tileHeight - 1) / tileHeight);
  if (tiles > tileLimit) return Error{"its JPEG 2000 stream has more than 4096 tiles"};
  const std::size_t components = numberAt<std::uint16_t>(stream, 40, true);
  if (components < 1 || stream.size() < 42 + 3 * components)
    return Error{"its JPEG 2000 stream has a damaged SIZ marker"};
  for (std::size_t at = 42; at < 42 + 3 * components; at += 3) {
    if (stream[at + 1] != 1 || stream[at + 2] != 1) return Error{"its JPEG 2000 stream is subsampled"};
    if (stream[at] != stream[42]) return Error{"the colours of its JPEG 2000 stream differ in precision"};
  }
  return StreamInfo{int(right - left), int(bottom - top), int(components), (stream[42] & 0x7f) + 1,
                    (stream[42] & 0x80) != 0};
}

Status checkStream(const StreamInfo& info, const PixelFormat& format, std::size_t streamBytes) {
  if (info.columns != format.columns || info.rows != format.rows)
    return Error{"its compressed picture has " + std::to_string(info.columns) + " x " +
                 std::to_string(info.rows) + " pixels, but the file says " + std::to_string(format.columns) +
                 " x " + std::to_string(format.rows)};
  if (info.components != format.samples)
    return Error{"its compressed picture has " + std::to_string(info.components) +
                 " colours, but the file says " + std::to_string(format.samples)};
  if (info.precision < 1 || info.precision > format.bitsAllocated)
    return Error{"its compressed picture has " + std::to_string(info.precision) +
                 " bits a pixel, but the file says " + std::to_string(format.bitsAllocated)};
  constexpr std::uint64_t largePicture = 256 << 20, largestRatio = 4096;
  if (format.frameBytes() > largePicture && streamBytes < format.frameBytes() / largestRatio)
    return Error{"its compressed picture is too short for its size"};
  return {};
}

}  // namespace volumen::dicom
