#include "io/deidentify/code_stream_notes.h"

#include <optional>

namespace volumen {

namespace {

enum Marker : std::uint16_t {
  startOfJpeg = 0xffd8,
  startOfJpeg2000 = 0xff4f,
  endOfStream = 0xffd9,
  startOfScan = 0xffda,
  startOfTile = 0xff90,
  fillBytes = 0xffff,
  jpegComment = 0xfffe,
  jpeg2000Comment = 0xff64,
  exif = 0xffe1,
  photoshop = 0xffed
};

// Returns true if a marker has no segment, and so no length.
bool isAlone(std::uint16_t marker, bool isJpeg2000) {
  const bool isOfJpeg = marker == 0xff01 || (marker >= 0xffd0 && marker <= 0xffd8);
  return isJpeg2000 ? marker >= 0xff30 && marker <= 0xff3f : isOfJpeg;
}

// Returns the bytes to overwrite in the segment at byte `at`; empty if it has no note. `length` includes its
// own two bytes.
std::optional<CodeStreamNote> noteOf(std::uint16_t marker, std::uint64_t at, std::size_t length,
                                     bool isJpeg2000) {
  constexpr std::size_t markerBytes = 2, lengthBytes = 2, kindBytes = 2;
  const std::uint64_t text = at + markerBytes + lengthBytes;
  if (isJpeg2000) {
    if (marker != jpeg2000Comment || length < lengthBytes + kindBytes) return {};
    return CodeStreamNote{text + kindBytes, length - lengthBytes - kindBytes, ' '};
  }
  if (marker == jpegComment) return CodeStreamNote{text, length - lengthBytes, ' '};
  if (marker == exif || marker == photoshop) return CodeStreamNote{text, length - lengthBytes, 0};
  return {};
}

}  // namespace

std::vector<CodeStreamNote> codeStreamNotes(const RegularFile& file, dicom::Range fragment) {
  constexpr int mostSegments = 10000;
  constexpr std::uint64_t segmentHeader = 4;
  const auto wordAt = [&](std::uint64_t at) {
    const auto bytes = file.read(at, 2);
    return bytes ? dicom::numberAt<std::uint16_t>(*bytes, 0, true) : std::uint16_t(0);
  };
  const std::uint64_t end = fragment.offset + fragment.length;
  if (fragment.length < segmentHeader) return {};
  const std::uint16_t start = wordAt(fragment.offset);
  if (start != startOfJpeg && start != startOfJpeg2000) return {};
  const bool isJpeg2000 = start == startOfJpeg2000;
  std::vector<CodeStreamNote> notes;
  std::uint64_t at = fragment.offset + 2;
  for (int n = 0; n < mostSegments && at + segmentHeader <= end; ++n) {
    const std::uint16_t marker = wordAt(at);
    if (marker == fillBytes) {
      ++at;
      continue;
    }
    if (marker == endOfStream || marker == (isJpeg2000 ? startOfTile : startOfScan)) return notes;
    const std::uint64_t length = wordAt(at + 2);
    const bool isSegment = marker >> 8 == 0xff && !isAlone(marker, isJpeg2000) && length >= 2;
    if (!isSegment || at + 2 + length > end) return {};
    if (const auto note = noteOf(marker, at, length, isJpeg2000)) notes.push_back(*note);
    at += 2 + length;
  }
  return {};
}

}  // namespace volumen
