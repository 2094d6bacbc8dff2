#include "io/dicom/decode.h"

#include "io/dicom/codestream.h"
#include "io/dicom/inflate.h"
#include "io/dicom/mosaic.h"
#include "io/worker/call.h"
#include "io/worker/dicom_fields.h"
#include "io/worker/progress.h"
#include "viewer/segment/packed_bits.h"

namespace volumen::dicom {
namespace {

/// Reads integers of type `Raw` as they are in a file and reduces them to their stored bits.
/// Writes them to `values`, which may lie where the bytes do if both are equally wide.
template <class Raw, class Value>
void unpackIntegers(const PixelFormat& format, Bytes bytes, std::span<Value> values) {
  const int shift = format.highBit + 1 - format.bitsStored, bits = format.bitsStored;
  const std::uint32_t mask = bits == 32 ? ~0u : (1u << bits) - 1, sign = 1u << (bits - 1);
  // Byte order and sign are constants of the loop: it is the whole cost of native pictures.
  const auto unpack = [&](auto isBigEndian, auto isSigned) {
    for (std::size_t n = 0; n < values.size(); ++n) {
      const std::uint32_t raw = numberAt<Raw>(bytes, n * sizeof(Raw), isBigEndian);
      const std::uint32_t stored = raw >> shift & mask;
      // (x ^ s) - s spreads the sign bit s over all bits above it.
      values[n] = isSigned ? Value(std::int32_t((stored ^ sign) - sign)) : Value(stored);
    }
  };
  constexpr std::true_type yes;
  constexpr std::false_type no;
  if (format.isSigned)
    format.bigEndian ? unpack(yes, yes) : unpack(no, yes);
  else
    format.bigEndian ? unpack(yes, no) : unpack(no, no);
}

template <class Raw, class Value>
std::vector<Value> unpackIntegers(const PixelFormat& format, Bytes bytes) {
  std::vector<Value> values(bytes.size() / sizeof(Raw));
  unpackIntegers<Raw>(format, bytes, std::span(values));
  return values;
}

template <class Value>
std::vector<Value> unpackFloats(const PixelFormat& format, Bytes bytes) {
  std::vector<Value> values(bytes.size() / sizeof(Value));
  for (std::size_t n = 0; n < values.size(); ++n)
    values[n] = numberAt<Value>(bytes, n * sizeof(Value), format.bigEndian);
  return values;
}

Samples unpack(const PixelFormat& format, Bytes bytes) {
  if (format.kind == PixelFormat::Kind::float32) return unpackFloats<float>(format, bytes);
  if (format.kind == PixelFormat::Kind::float64) return unpackFloats<double>(format, bytes);
  if (format.bitsAllocated == 8 && !format.isSigned)
    return unpackIntegers<std::uint8_t, std::uint8_t>(format, bytes);
  if (format.bitsAllocated == 8) return unpackIntegers<std::uint8_t, std::int16_t>(format, bytes);
  if (format.bitsAllocated == 16 && !format.isSigned)
    return unpackIntegers<std::uint16_t, std::uint16_t>(format, bytes);
  if (format.bitsAllocated == 16) return unpackIntegers<std::uint16_t, std::int16_t>(format, bytes);
  if (!format.isSigned) return unpackIntegers<std::uint32_t, std::uint32_t>(format, bytes);
  return unpackIntegers<std::uint32_t, std::int32_t>(format, bytes);
}

bool isYbr(const PixelFormat& format) { return format.photometric.starts_with("YBR_FULL"); }

/// Unpacks samples from a decoder that delivers little endian bytes.
Result<DecodedFrame> unpackDecoded(PixelFormat format, const Result<std::vector<std::uint8_t>>& decoded) {
  if (!decoded) return decoded.error();
  if (decoded->size() != format.frameBytes()) return Error{"its decoded picture has the wrong size"};
  format.bigEndian = format.bytesInWords = false;
  return DecodedFrame{unpack(format, *decoded), {}, isYbr(format)};
}

/// Follows the stream if it contradicts PhotometricInterpretation, as the stream was written first.
void colourAsStreamSays(JpegColours said, const PixelFormat& format, DecodedFrame& frame) {
  const bool ybr = said == JpegColours::ybr;
  if (said == JpegColours::unsaid || ybr == frame.ybr) return;
  frame.ybr = ybr;
  frame.note = "its PhotometricInterpretation is " + format.photometric +
               ", and its JPEG stream says that it is " + (ybr ? "YBR" : "RGB") +
               ": it is shown as the stream says";
}

/// Interleaves colour planes pixel by pixel.
template <class Value>
std::vector<Value> interleaved(const std::vector<Value>& planes, std::size_t colours) {
  std::vector<Value> pixels(planes.size());
  const std::size_t count = planes.size() / colours;
  for (std::size_t colour = 0; colour < colours; ++colour)
    for (std::size_t n = 0; n < count; ++n) pixels[n * colours + colour] = planes[colour * count + n];
  return pixels;
}

/// Expands Y Y Cb Cr of two pixels to Y Cb Cr of each.
template <class Value>
std::vector<Value> upsampled(const std::vector<Value>& pairs) {
  std::vector<Value> pixels;
  pixels.reserve(pairs.size() / 2 * 3);
  for (std::size_t n = 0; n + 3 < pairs.size(); n += 4)
    for (std::size_t luma : {n, n + 1})
      pixels.insert(pixels.end(), {pairs[luma], pairs[n + 2], pairs[n + 3]});
  return pixels;
}

Samples unpackNative(const PixelFormat& format, Bytes bytes) {
  Samples samples = unpack(format, bytes);
  if (!format.subsampled && !format.planar) return samples;
  return std::visit(
      [&](const auto& values) -> Samples {
        if (format.subsampled) return upsampled(values);
        return interleaved(values, std::size_t(format.samples));
      },
      samples);
}

/// Unpacks frame `n` of native samples. `bytes` are the frame's own; for 1-bit pixels, and for bytes in big
/// endian words, they are the 16-bit words that contain it.
Result<DecodedFrame> nativeFrame(const PixelFormat& format, int n, Bytes bytes) {
  std::vector<std::uint8_t> swapped;
  if (format.bytesInWords) {
    if (bytes.size() % 2 == 1) return Error{"its pixel data is cut off"};
    swapped.assign(bytes.begin(), bytes.end());
    swapBytesOfWords(swapped);
    bytes = swapped;
  }
  const bool inWords = format.isBits() || format.bytesInWords;
  const std::uint64_t bits = format.frameSamples() * std::uint64_t(format.bitsAllocated),
                      before = inWords ? std::uint64_t(n) * bits % 16 : 0;
  if (inWords ? bytes.size() * 8 < before + bits : bytes.size() != format.frameBytes())
    return Error{"its pixel data is cut off"};
  if (!format.isBits())
    return DecodedFrame{
        unpackNative(format, bytes.subspan(before / 8, format.frameBytes())), {}, isYbr(format)};
  std::vector<std::uint8_t> values(format.frameSamples());
  unpackBits(bytes, before, values);
  return DecodedFrame{std::move(values), {}, false};
}

/// Joins all fragments of a frame.
template <class Read>
Result<std::vector<std::uint8_t>> joined(const FrameRanges& ranges, const Read& read) {
  std::vector<std::uint8_t> all;
  for (const Range& range : ranges) {
    auto part = read(range);
    if (!part) return part.error();
    if (all.empty())
      all = std::move(*part);
    else
      all.insert(all.end(), part->begin(), part->end());
  }
  return all;
}

/// Returns whether the file holds samples contiguously, in the width of the result.
bool isReadInPlace(const PixelFormat& format, const TransferSyntax& syntax, const FrameRanges& ranges) {
  const bool isPlain = syntax.coding == Coding::native && format.kind == PixelFormat::Kind::integer &&
                       !format.bytesInWords && !format.subsampled && !format.planar;
  const bool isAsWide = format.bitsAllocated == 16 || (format.bitsAllocated == 8 && !format.isSigned);
  return isPlain && isAsWide && ranges.size() == 1 && ranges[0].length == format.frameBytes();
}

/// Reads a frame to where its samples will be: a large one is in memory once. Unpacks by pieces that stay in
/// the cache.
template <class Value>
Result<DecodedFrame> readInPlace(const RegularFile& file, const PixelFormat& format, Range range) {
  constexpr std::uint64_t pieceBytes = 1 << 18;
  if (range.offset > file.size() || range.length > file.size() - range.offset)
    return Error{"the file is cut off"};
  std::vector<Value> samples(format.frameSamples());
  const std::span all(reinterpret_cast<std::uint8_t*>(samples.data()), range.length);
  for (std::uint64_t done = 0; done < range.length; done += pieceBytes) {
    const auto piece = all.subspan(done, std::min(pieceBytes, range.length - done));
    const auto got = file.readAt(range.offset + done, piece.data(), piece.size());
    if (!got) return got.error();
    if (*got < piece.size()) return Error{"the file became shorter while it was read"};
    unpackIntegers<std::make_unsigned_t<Value>>(
        format, piece, std::span(samples).subspan(done / sizeof(Value), piece.size() / sizeof(Value)));
    worker::tellRead(done + piece.size(), range.length);
  }
  return DecodedFrame{std::move(samples), {}, isYbr(format)};
}

Result<DecodedFrame> readInPlace(const RegularFile& file, const PixelFormat& format, Range range) {
  if (format.bitsAllocated == 8) return readInPlace<std::uint8_t>(file, format, range);
  return format.isSigned ? readInPlace<std::int16_t>(file, format, range)
                         : readInPlace<std::uint16_t>(file, format, range);
}

/// Decodes a frame within a worker.
Result<DecodedFrame> decodeRanges(const std::string& path, const PixelFormat& format,
                                  const TransferSyntax& syntax, const FrameRanges& ranges) {
  const Result<RegularFile> file = RegularFile::open(path);
  if (!file) return file.error();
  const auto bytes = joined(ranges, [&](Range r) { return file->read(r.offset, r.length); });
  if (!bytes) return bytes.error();
  return decodeFrame(format, syntax, *bytes);
}

Result<std::vector<std::uint8_t>> inflateFrom(const std::string& path, std::uint64_t offset) {
  const Result<RegularFile> file = RegularFile::open(path);
  if (!file) return file.error();
  const std::uint64_t size = file->size();
  const auto deflated = file->read(offset, size - std::min(size, offset));
  if (!deflated) return deflated.error();
  return inflateAll(*deflated);
}

Result<DecodedFrame> decodeIsolated(const std::string& path, const PixelFormat& format,
                                    const TransferSyntax& syntax, const FrameRanges& ranges,
                                    const CancelToken& cancel) {
  constexpr std::uint64_t widest = 8, besides = 1 << 20;
  const std::uint64_t samples = format.framePixels() * std::uint64_t(format.samples);
  worker::Request request{.files = {path}, .needBytes = samples * std::uint64_t(format.bitsAllocated / 8)};
  request.mostBytes = samples * widest + besides;
  request.cancel = &cancel;
  worker::Failure failure{};
  auto frame = worker::isolated<decodeRanges>(request, failure, path, format, syntax, ranges);
  if (!frame) return frame;
  const auto count = std::visit([](const auto& values) { return values.size(); }, frame->samples);
  if (count != samples) return Error{worker::reasonOf(worker::Failure::wrong)};
  return frame;
}

}  // namespace

Result<DecodedFrame> decodeFrame(const PixelFormat& format, const TransferSyntax& syntax, Bytes bytes,
                                 int n) {
  if (format.isBits() && syntax.coding != Coding::native) return Error{"only native pixels have one bit"};
  switch (syntax.coding) {
    case Coding::native:
      return nativeFrame(format, n, bytes);
    case Coding::rle:
      return unpackDecoded(format, decodeRle(format, bytes));
    case Coding::jpeg:
    case Coding::jpegLs: {
      auto decoded = unpackDecoded(format, decodeJpeg(format, syntax, bytes));
      if (decoded && format.samples > 1) colourAsStreamSays(jpegColours(bytes), format, *decoded);
      return decoded;
    }
    case Coding::jpeg2000:
      return decodeJpeg2000(format, bytes);
    case Coding::unsupported:
      break;
  }
  return Error{"its transfer syntax \"" + std::string(syntax.name) + "\" is not supported"};
}

Result<PixelSource> PixelSource::open(const FileHeader& header, const CancelToken& cancel) {
  PixelSource source(header, cancel);
  if (Status opened = source.openFile(); !opened) return opened.error();
  if (!header.mosaic) return source;
  auto whole = source.decoded(0, wholeMosaic(header.format, *header.mosaic));
  if (!whole) return whole.error();
  source.mosaic_ = std::move(*whole);
  return source;
}

Status PixelSource::openFile() {
  if (isDecodedInWorkers()) return {};
  Result<RegularFile> file = RegularFile::open(header_.path);
  if (!file) return file.error();
  if (header_.inflatedFrom) return inflate(file->size());
  file_.emplace(std::move(*file));
  return {};
}

bool PixelSource::isDecodedInWorkers() const {
  return worker::isolating() && header_.syntax.coding != Coding::native;
}

Status PixelSource::inflate(std::uint64_t fileSize) {
  constexpr std::uint64_t besides = 1 << 20;
  worker::Request request{.files = {header_.path}, .needBytes = mostInflated(fileSize)};
  request.mostBytes = request.needBytes + besides;
  request.cancel = &cancel_;
  worker::Failure failure{};
  auto inflated = worker::isolated<inflateFrom>(request, failure, header_.path, header_.inflatedFrom);
  if (!inflated) return inflated.error();
  inflated_ = std::move(*inflated);
  return {};
}

Result<std::vector<std::uint8_t>> PixelSource::bytes(Range range) const {
  if (!header_.inflatedFrom) return file_->read(range.offset, range.length);
  if (range.offset > inflated_.size() || range.length > inflated_.size() - range.offset)
    return Error{"its pixel data is cut off"};
  const auto begin = inflated_.begin() + std::ptrdiff_t(range.offset);
  return std::vector<std::uint8_t>(begin, begin + std::ptrdiff_t(range.length));
}

Result<DecodedFrame> PixelSource::frame(int n) const {
  if (mosaic_) return tileOf(*mosaic_, n, header_.format, *header_.mosaic);
  return decoded(n, header_.format);
}

Result<DecodedFrame> PixelSource::frame(int n, const PixelFormat& format) const {
  if (!mosaic_) return decoded(n, format);
  const auto whole = decoded(0, wholeMosaic(format, *header_.mosaic));
  if (!whole) return whole.error();
  return tileOf(*whole, n, format, *header_.mosaic);
}

// Native samples need no decoder, so this process unpacks them itself.
Result<DecodedFrame> PixelSource::decoded(int n, const PixelFormat& format) const {
  const FrameRanges& ranges = header_.frames[std::size_t(n)];
  if (isDecodedInWorkers()) return decodeIsolated(header_.path, format, header_.syntax, ranges, cancel_);
  if (file_ && isReadInPlace(format, header_.syntax, ranges)) return readInPlace(*file_, format, ranges[0]);
  const auto joinedBytes = joined(ranges, [&](Range r) { return bytes(r); });
  if (!joinedBytes) return joinedBytes.error();
  auto frame = decodeFrame(format, header_.syntax, *joinedBytes, n);
  worker::tellRead(format.frameBytes(), format.frameBytes());
  return frame;
}

}  // namespace volumen::dicom
