#include "io/deidentify/copied_pixels.h"

#include <algorithm>
#include <optional>

#include "io/deidentify/code_stream_notes.h"
#include "io/dicom/attributes.h"
#include "io/dicom/fragments.h"

namespace volumen {

namespace {

using dicom::DataSet;
using dicom::Element;
using dicom::PixelFormat;
using dicom::ScannedFile;

// Returns the format of the pixels; empty if the attributes of the file do not define it.
std::optional<PixelFormat> formatOf(const DataSet& data, const Element& pixels) {
  std::vector<std::string> ignored;
  auto format = dicom::readPixelFormat(data, pixels, {}, ignored);
  if (!format) return {};
  // Some files declare YBR_FULL_422 but store every sample.
  format->subsampled = format->photometric == "YBR_FULL_422" && pixels.length < format->allBytes();
  return *std::move(format);
}

// Returns the bit positions of overlays that are embedded in the pixels. Their groups have no data of their
// own.
std::vector<int> overlayBits(const DataSet& data) {
  std::vector<int> bits;
  for (std::uint32_t group = 0x60000000; group <= 0x60fe0000; group += 0x00020000) {
    constexpr std::uint32_t rows = 0x0010, position = 0x0102, overlayData = 0x3000;
    const bool isEmbedded =
        data.has(group | rows, data.root()) && !data.has(group | overlayData, data.root());
    if (isEmbedded) bits.push_back(data.word(group | position, data.root()).value_or(0));
  }
  return bits;
}

bool isUnused(int bit, const PixelFormat& f) {
  const int lowest = f.highBit + 1 - f.bitsStored;
  return bit < f.bitsAllocated && (bit > f.highBit || bit < lowest);
}

bool hasClearableBits(const PixelFormat& f) {
  return f.kind == PixelFormat::Kind::integer && f.samples == 1 &&
         (f.bitsAllocated == 8 || f.bitsAllocated == 16);
}

// Returns the bits of each pixel to keep, as FilePart::kept.
std::uint16_t keptBits(const std::vector<int>& overlays, const PixelFormat& f) {
  std::uint32_t kept = allBits;
  for (const int bit : overlays)
    if (hasClearableBits(f) && isUnused(bit, f)) kept &= ~(1u << bit);
  const std::uint32_t low = kept & 0xff, high = kept >> 8;
  if (f.bitsAllocated == 8) return std::uint16_t(low << 8 | low);
  return std::uint16_t(f.bigEndian ? low << 8 | high : kept);
}

// Returns the number of bytes of all pixels.
std::uint64_t pixelBytes(const PixelFormat& f) {
  constexpr std::uint64_t bitsOfByte = 8;
  // Some writers begin each frame of a bitmap at a whole byte.
  const std::uint64_t frame = (f.framePixels() + bitsOfByte - 1) / bitsOfByte;
  const std::uint64_t bytes = f.isBits() ? frame * std::uint64_t(f.frames) : f.allBytes();
  return f.bytesInWords ? bytes + bytes % 2 : bytes;
}

CopiedPixels addNative(const Element& e, const std::optional<PixelFormat>& format,
                       const std::vector<int>& overlays, FileParts& parts) {
  if (!format) {
    parts.copy(e.offset, e.length);
    return {!overlays.empty()};
  }
  constexpr std::uint16_t none = 0;
  const std::uint64_t used = std::min(e.length, pixelBytes(*format));
  parts.copy(e.offset, used, keptBits(overlays, *format));
  parts.copy(e.offset + used, e.length - used, none);
  const auto stays = [&](int bit) {
    return bit > 0 && !(hasClearableBits(*format) && isUnused(bit, *format));
  };
  return {std::ranges::any_of(overlays, stays)};
}

Status addFragments(const Element& e, const RegularFile& file, FileParts& parts) {
  const auto end = dicom::endOfFragments(file, e);
  if (!end) return end.error();
  std::uint64_t at = e.offset;
  // The fragments are read as if they were one frame. Those that begin no code stream have no notes.
  const auto frames = dicom::encapsulatedFrames(file, e, 1);
  if (frames)
    for (const dicom::Range& fragment : frames->front())
      for (const CodeStreamNote& note : codeStreamNotes(file, fragment)) {
        parts.copy(at, note.offset - at);
        parts.add(std::string(note.length, note.blank));
        at = note.offset + note.length;
      }
  parts.copy(at, *end - at);
  return {};
}

}  // namespace

Result<CopiedPixels> addPixels(const ScannedFile& s, const RegularFile& file, FileParts& parts) {
  if (!s.dataSet.pixels) return CopiedPixels{};
  const Element& e = *s.dataSet.pixels;
  const DataSet data(s.head, s.dataSet.elements);
  const std::vector<int> overlays = overlayBits(data);
  const std::uint16_t vr = e.vr ? e.vr : dicom::vrOf('O', 'W');
  if (e.length != dicom::undefinedLength) {
    if (e.offset + e.length > s.size) return Error{"its pixels are cut off"};
    parts.addHeader(s.syntax.encoding, e.tag, vr, std::uint32_t(e.length));
    return addNative(e, formatOf(data, e), overlays, parts);
  }
  if (s.inflatedFrom) return Error{"its pixels are compressed twice"};
  parts.addHeader(s.syntax.encoding, e.tag, vr, std::uint32_t(dicom::undefinedLength));
  if (Status added = addFragments(e, file, parts); !added) return added.error();
  return CopiedPixels{std::ranges::any_of(overlays, [](int bit) { return bit > 0; })};
}

}  // namespace volumen
