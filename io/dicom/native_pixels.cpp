#include "io/dicom/native_pixels.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcpixel.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <span>

#include "io/dicom/attributes.h"
#include "io/dicom/decode.h"
#include "io/dicom/fragments.h"

namespace volumen::dicom {
namespace {

// What the decoded frames turn out to be, where the header of the file may say otherwise.
struct Decoded {
  bool isSigned = false, ybr = false;
  int bitsStored = 0;
};

// Returns the bits that integers from `low` to `high` take.
int bitsOf(std::int64_t low, std::int64_t high, bool isSigned) {
  int bits = 1;
  if (isSigned)
    while (low < -(std::int64_t(1) << (bits - 1)) || high >= std::int64_t(1) << (bits - 1)) ++bits;
  else
    while (high >= std::int64_t(1) << bits) ++bits;
  return bits;
}

// Writes the samples of a frame in 16-bit words from byte `at` on, little endian.
void writeSamples(const DecodedFrame& frame, int bytesASample, std::span<Uint16> words, std::uint64_t at,
                  Decoded& decoded) {
  std::visit(
      [&]<class Value>(const std::vector<Value>& samples) {
        if constexpr (std::is_integral_v<Value>) {
          for (const Value sample : samples)
            for (int n = 0; n < bytesASample; ++n, ++at)
              words[at / 2] = Uint16(words[at / 2] | (std::uint32_t(sample) >> 8 * n & 0xff) << at % 2 * 8);
          const auto [low, high] = std::ranges::minmax(samples);
          decoded.isSigned = std::is_signed_v<Value>;
          decoded.bitsStored = std::max(decoded.bitsStored, bitsOf(low, high, decoded.isSigned));
        }
      },
      frame.samples);
  decoded.ybr = frame.ybr;
}

// Fills `words`, which are 0, with all frames. Decoding needs no more than one frame besides.
Result<Decoded> decodeInto(const RegularFile& file, const ScannedFile& scanned, const PixelFormat& format,
                           std::span<Uint16> words) {
  const auto frames = encapsulatedFrames(file, *scanned.dataSet.pixels, format.frames);
  if (!frames) return frames.error();
  Decoded decoded{format.isSigned, false, format.bitsStored};
  for (std::size_t n = 0; n < frames->size(); ++n) {
    std::vector<std::uint8_t> bytes;
    for (const Range& range : (*frames)[n]) {
      const auto part = file.read(range.offset, range.length);
      if (!part) return part.error();
      bytes.insert(bytes.end(), part->begin(), part->end());
    }
    const auto frame = decodeFrame(format, scanned.syntax, bytes);
    if (!frame) return frame.error();
    writeSamples(*frame, format.bitsAllocated / 8, words, n * format.frameBytes(), decoded);
  }
  return decoded;
}

void describe(const PixelFormat& format, const Decoded& decoded, DcmDataset& data) {
  data.putAndInsertUint16(DCM_BitsStored, Uint16(decoded.bitsStored));
  data.putAndInsertUint16(DCM_HighBit, Uint16(decoded.bitsStored - 1));
  data.putAndInsertUint16(DCM_PixelRepresentation, decoded.isSigned ? 1 : 0);
  if (format.samples == 1) return;
  data.putAndInsertString(DCM_PhotometricInterpretation, decoded.ybr ? "YBR_FULL" : "RGB");
  data.putAndInsertUint16(DCM_PlanarConfiguration, 0);
}

}  // namespace

Status putNativePixels(const RegularFile& file, const ScannedFile& scanned, DcmDataset& data) {
  if (scanned.dataSet.pixels->length != undefinedLength) return Error{"its pixel data is not in fragments"};
  std::vector<std::string> ignored;
  const auto format =
      readPixelFormat(DataSet(scanned.head, scanned.dataSet.elements), *scanned.dataSet.pixels, {}, ignored);
  if (!format) return format.error();
  if (format->kind != PixelFormat::Kind::integer) return Error{"its pixels are not integers"};
  auto pixels = std::make_unique<DcmPixelData>(DcmTag(DCM_PixelData, EVR_OW));
  const std::uint64_t count = format->allBytes() / 2 + format->allBytes() % 2;
  Uint16* words = nullptr;
  if (count > std::numeric_limits<Uint32>::max() / 2 || pixels->createUint16Array(Uint32(count), words).bad())
    return Error{"it is too large without compression"};
  std::fill_n(words, count, Uint16(0));
  const auto decoded = decodeInto(file, scanned, *format, {words, count});
  if (!decoded) return decoded.error();
  describe(*format, *decoded, data);
  data.insert(pixels.release(), true);
  return {};
}

}  // namespace volumen::dicom
