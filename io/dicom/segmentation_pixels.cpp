#include "io/dicom/segmentation_pixels.h"

#include <algorithm>
#include <type_traits>

#include "io/dicom/decode.h"
#include "viewer/segment/packed_bits.h"

namespace volumen::dicom {

namespace {

std::uint64_t evenLength(std::uint64_t bytes) { return bytes + bytes % 2; }

}  // namespace

std::uint64_t SegmentationPixels::bytesThere() const {
  const Element& pixels = *file_.scanned.dataSet.pixels;
  return std::min(pixels.length, file_.scanned.size - std::min(file_.scanned.size, pixels.offset));
}

// If the pixel data is longer than Rows x Columns x NumberOfFrames, padded to an even length, one of these is
// wrong. All pixels are then in other places than they seem.
Status SegmentationPixels::checkLength(std::uint64_t bitsOfPixel) const {
  const std::uint64_t needed = (framePixels() * std::uint64_t(frames_) * bitsOfPixel + 7) / 8;
  const std::string ofNeeded =
      std::to_string(bytesThere()) + " of " + std::to_string(needed) + " bytes are there" + picturesDiffer();
  if (bytesThere() < needed) return Error{"its pixel data is cut off: " + ofNeeded};
  if (file_.scanned.dataSet.pixels->length <= evenLength(needed)) return {};
  return Error{"its pixel data is longer than Rows x Columns x NumberOfFrames (" + std::to_string(size_.y) +
               " x " + std::to_string(size_.x) + " x " + std::to_string(frames_) + "): " + ofNeeded};
}

std::string SegmentationPixels::picturesDiffer() const {
  if (pictures_ == glm::ivec2(0) || pictures_ == size_) return {};
  return "; the pictures that it names have " + std::to_string(pictures_.y) + " rows and " +
         std::to_string(pictures_.x) + " columns";
}

Result<std::vector<std::uint8_t>> SegmentationPixels::bytesAt(std::uint64_t offset,
                                                              std::uint64_t length) const {
  if (file_.scanned.inflatedFrom > 0) {
    const auto begin = file_.scanned.head.begin() + std::ptrdiff_t(offset);
    return std::vector<std::uint8_t>(begin, begin + std::ptrdiff_t(length));
  }
  const auto file = RegularFile::open(path_);
  if (!file) return file.error();
  return file->read(offset, length);
}

// Returns whether the length of the pixel data fits frames of whole bytes each, and nothing else.
bool SegmentationPixels::arePadded() const {
  const std::uint64_t length = file_.scanned.dataSet.pixels->length, frames = std::uint64_t(frames_);
  const std::uint64_t bits = (framePixels() * frames + 7) / 8, padded = (framePixels() + 7) / 8 * frames;
  return padded > evenLength(bits) && bytesThere() == length &&
         (length == padded || length == evenLength(padded));
}

std::vector<std::uint8_t> SegmentationPixels::withoutPadding(std::span<const std::uint8_t> bytes) const {
  const std::size_t pixels = framePixels(), perFrame = (pixels + 7) / 8;
  std::vector<std::uint64_t> words((pixels + 63) / 64);
  BitPacker bits;
  for (std::size_t n = 0; n < std::size_t(frames_); ++n) {
    unpackWords(bytes, 8 * n * perFrame, pixels, words);
    bits.add(words, pixels);
  }
  return bits.bytes();
}

Result<std::vector<std::uint8_t>> SegmentationPixels::bits(std::vector<std::string>& notes) const {
  const ScannedFile& scanned = file_.scanned;
  const Element& pixels = *scanned.dataSet.pixels;
  if (scanned.syntax.coding != Coding::native || pixels.length == undefinedLength)
    return Error{"its frames of one bit a pixel are compressed (" + std::string(scanned.syntax.name) +
                 "), which is not read"};
  const bool padded = arePadded();
  if (!padded)
    if (Status s = checkLength(1); !s) return s.error();
  auto bytes = bytesAt(pixels.offset, bytesThere());
  if (!bytes) return bytes;
  if (pixels.bigEndian && pixels.vr == vrOf('O', 'W')) swapBytesOfWords(*bytes);
  if (!padded) return bytes;
  notes.push_back("The frames of " + path_ +
                  " begin on whole bytes, as the length of its pixel data says, not one behind the other as "
                  "DICOM has them: they were read so.");
  return withoutPadding(*bytes);
}

Status SegmentationPixels::forEachFrame(const TakeFrame& take) const {
  const std::uint64_t bitsOfPixel = data_.word(0x00280100, data_.root()).value_or(8);
  if (file_.scanned.syntax.coding == Coding::native)
    if (Status s = checkLength(bitsOfPixel); !s) return s;
  const auto file = RegularFile::open(path_);
  if (!file) return file.error();
  FileHeader header;
  header.path = path_;
  header.syntax = file_.scanned.syntax;
  header.inflatedFrom = file_.scanned.inflatedFrom;
  if (Status s = readPicture(*file, file_.scanned, data_, header); !s) return s;
  const auto pixels = PixelSource::open(header);
  if (!pixels) return pixels.error();
  std::vector<int> numbers;
  for (std::size_t n = 0; n < std::size_t(frames_); ++n) {
    const auto decoded = pixels->frame(int(n));
    if (!decoded) return decoded.error();
    std::visit([&](const auto& samples) { numbers.assign(samples.begin(), samples.end()); },
               decoded->samples);
    if (numbers.size() != framePixels()) return Error{"its frames are not of Rows x Columns pixels"};
    if (Status s = take(n, numbers); !s) return s;
  }
  return {};
}

}  // namespace volumen::dicom
