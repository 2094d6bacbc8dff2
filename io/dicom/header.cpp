#include "io/dicom/header.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>

#include "io/dicom/attributes.h"
#include "io/dicom/derived_object.h"
#include "io/dicom/directory.h"
#include "io/dicom/mosaic.h"
#include "io/dicom/stack.h"
#include "io/frame_limit.h"
#include "io/regular_file.h"

namespace volumen::dicom {
namespace {

constexpr std::uint64_t sizeLimit = std::uint64_t(16) << 30;
constexpr const char* explicitLittleEndian = "1.2.840.10008.1.2.1";

Inspection refused(const std::string& reason) {
  std::string sentence = reason + ".";
  return {Inspection::Kind::refused, sentence, {}, {}, {}};
}

Error tooLarge(std::uint64_t framePixels) {
  return {"a frame of it has " + std::to_string(framePixels / 1'000'000) + " million pixels; more than " +
          framePixelLimitText() + " are only read with --largest-frame"};
}

/// Returns "DICOM file without pixel data (SR)".
std::string kindOf(const FileHeader& header) {
  const char* name = header.sopClassUid.empty() ? nullptr : dcmFindNameOfUID(header.sopClassUid.c_str());
  const std::string known = !header.modality.empty() ? header.modality : name ? name : "";
  return "DICOM file without pixel data" + (known.empty() ? "" : " (" + known + ")");
}

/// Returns the 16-bit words that hold each frame's bits or bytes. Adjacent frames may share a word.
Result<std::vector<FrameRanges>> wordFrames(std::uint64_t offset, const PixelFormat& format,
                                            std::uint64_t have) {
  if (format.bytesInWords && have % 2 == 1 && have == format.allBytes())
    return Error{"its pixel data ends within a big endian word"};
  const std::uint64_t bits = format.frameSamples() * std::uint64_t(format.bitsAllocated);
  std::vector<FrameRanges> frames;
  for (std::uint64_t n = 0; n < std::uint64_t(format.frames); ++n) {
    const std::uint64_t begin = n * bits / 16 * 2;
    const std::uint64_t end = std::min(((n + 1) * bits + 15) / 16 * 2, have);
    frames.push_back({{offset + begin, end - begin}});
  }
  return frames;
}

Result<std::vector<FrameRanges>> nativeFrames(const Element& pixels, const PixelFormat& format,
                                              std::uint64_t size) {
  const std::uint64_t needed = format.allBytes();
  const std::uint64_t have = std::min(pixels.length, size - std::min(size, pixels.offset));
  if (have < needed)
    return Error{"its pixel data is cut off: " + std::to_string(have) + " of " + std::to_string(needed) +
                 " bytes are there"};
  if (format.isBits() || format.bytesInWords) return wordFrames(pixels.offset, format, have);
  std::vector<FrameRanges> frames;
  for (int n = 0; n < format.frames; ++n)
    frames.push_back({{pixels.offset + std::uint64_t(n) * format.frameBytes(), format.frameBytes()}});
  return frames;
}

/// Returns whether pixels declared as compressed are native: not in fragments, and as long as their samples.
bool isNativeAfterAll(const Element& pixels, const TransferSyntax& syntax, const PixelFormat& format) {
  if (syntax.coding == Coding::native || syntax.coding == Coding::unsupported) return false;
  return pixels.length == format.allBytes() + format.allBytes() % 2;
}

/// Returns whether a file without preamble begins with group 0002, 0004 or 0008 in either byte order.
bool beginsAsDicom(Bytes head) {
  if (head.size() < 8) return false;
  const std::uint16_t group = numberAt<std::uint16_t>(head, 0, false);
  return group == 0x0002 || group == 0x0004 || group == 0x0008 || group == 0x0800;
}

/// Stores the identity of a file without a usable picture, and its position.
void keepIdentity(const DataSet& data, const FileHeader& header, Inspection& found) {
  static_cast<SeriesIdentity&>(found.header) = header;
  const auto at = data.numbers(0x00200032, data.root());
  if (at && at->size() == 3) found.position = glm::dvec3((*at)[0], (*at)[1], (*at)[2]);
}

/// Returns a refusal with the identity of the file.
Inspection refused(const std::string& reason, const DataSet& data) {
  Inspection found = refused(reason);
  FileHeader header;
  readIdentity(data, header);
  keepIdentity(data, header, found);
  return found;
}

/// Returns whether a file is the beginning of an empty preamble, as left by an interrupted copy.
bool isBrokenOff(Bytes head) {
  std::array<std::uint8_t, 132> preamble{};
  std::memcpy(preamble.data() + 128, "DICM", 4);
  return head.size() < preamble.size() && std::equal(head.begin(), head.end(), preamble.begin());
}

/// Returns the inspection of a file without a picture, with the pictures it refers to.
Inspection withoutPicture(const DataSet& data, const FileHeader& header) {
  Inspection found{Inspection::Kind::noPicture, kindOf(header), {}, {}, {}};
  keepIdentity(data, header, found);
  if (data.find(directoryRecords, data.root())) found.listed = listedFiles(data);
  if (const auto kind = derivedKind(header.sopClassUid)) {
    found.derivedObject = readDerivedObject(data, header, *kind);
    if (kind == DerivedKind::segmentation) found.text = "DICOM segmentation";
  }
  return found;
}

/// Returns whether values may be an uptake: PET, except for secondary captures without Units.
bool isPet(const DataSet& data, const FileHeader& header) {
  const std::string& sopClass = header.sopClassUid;
  const bool isCapture = sopClass == UID_SecondaryCaptureImageStorage ||
                         sopClass.starts_with(std::string(UID_SecondaryCaptureImageStorage) + ".");
  return header.modality == "PT" && (!isCapture || data.has(0x00541001, data.root()));
}

/// Inspects a file and leaves its elements in `s`.
Inspection inspectInto(const std::string& path, ScannedFile& s) {
  const Result<RegularFile> file = RegularFile::open(path);
  if (!file) {
    Inspection found = refused(file.message());
    found.again = file.message() == tooManyOpen;
    return found;
  }
  if (Status read = s.begin(*file); !read) return refused(read.message());
  if (isBrokenOff(s.head))
    return refused(s.head.empty() ? "it is empty" : "it is cut off in front of its header");
  const Result<MetaHeader> meta = scanMeta(s.head, file->size());
  const bool magic = hasMagic(s.head);
  if (!magic && !beginsAsDicom(s.head)) return {};
  if (!meta) return magic ? refused(meta.message()) : Inspection{};
  s.meta = *meta;
  if (Status named = s.findSyntax(); !named) return refused(named.message());
  const Status scanned = s.scan(*file);
  const bool looksLikeDicom = magic || !s.meta.transferSyntaxUid.empty();
  const DataSet data(s.head, s.dataSet.elements);
  if (!scanned) return looksLikeDicom ? refused(scanned.message(), data) : Inspection{};
  // A file without preamble is DICOM only if it has a SOP class or a modality.
  const bool named = data.has(0x00080016, data.root()) || data.has(0x00080060, data.root());
  if (!looksLikeDicom && !named) return {};
  Inspection found{Inspection::Kind::picture, {}, {}, {}, {}};
  found.header.path = path;
  found.header.syntax = s.syntax;
  found.header.inflatedFrom = s.inflatedFrom;
  readIdentity(data, found.header);
  if (isPet(data, found.header)) found.header.pet = readPetFacts(data);
  const bool isSegmentation = derivedKind(found.header.sopClassUid) == DerivedKind::segmentation;
  if (!s.dataSet.pixels || isSegmentation) return withoutPicture(data, found.header);
  if (Status picture = readPicture(*file, s, data, found.header); !picture)
    return refused(picture.message(), data);
  std::ranges::copy(data.remarks(), std::back_inserter(found.header.warnings));
  return found;
}

/// Returns the first bytes of native pixels, or none if the file states PixelRepresentation.
Result<std::vector<std::uint8_t>> beginOfPixels(const RegularFile& file, const ScannedFile& s,
                                                const DataSet& data) {
  constexpr std::uint64_t enough = 64 << 10;
  const Element& pixels = *s.dataSet.pixels;
  const std::uint64_t there = s.size - std::min(s.size, pixels.offset);
  const bool isSaid = data.has(0x00280103, data.root());
  if (isSaid || pixels.length == undefinedLength || s.inflatedFrom) return std::vector<std::uint8_t>();
  return file.read(pixels.offset, std::min({enough, pixels.length, there}));
}

/// Reads the pixel format and the true transfer syntax.
Status readFormat(const RegularFile& file, const ScannedFile& s, const DataSet& data, FileHeader& header) {
  constexpr std::uint32_t planarConfiguration = 0x00280006;
  const Element& pixels = *s.dataSet.pixels;
  const auto begin = beginOfPixels(file, s, data);
  if (!begin) return begin.error();
  auto format = readPixelFormat(data, pixels, *begin, header.warnings);
  if (!format) return format.error();
  header.format = *format;
  if (!s.remark.empty()) header.warnings.push_back(s.remark);
  if (isNativeAfterAll(pixels, s.syntax, *format)) {
    header.warnings.push_back("its transfer syntax is \"" + std::string(s.syntax.name) +
                              "\", and its pixels are not compressed: they were read as they are");
    header.syntax = transferSyntax(explicitLittleEndian);
    header.syntax.encoding = s.syntax.encoding;
  }
  const bool isNative = header.syntax.coding == Coding::native;
  header.format.subsampled = isNative && format->photometric == "YBR_FULL_422";
  if (header.format.subsampled && format->columns % 2 == 1)
    return Error{"its rows are odd, and YBR_FULL_422 stores two pixels at a time"};
  if (isNative && format->samples > 1 && !header.format.subsampled &&
      !data.has(planarConfiguration, data.root()))
    header.warnings.emplace_back("its PlanarConfiguration is missing: its colours were read pixel by pixel");
  return {};
}

/// Warns of native pixels after the last frame, and of compressed pixels without end mark.
void tellLength(const ScannedFile& s, const std::vector<FrameRanges>& frames, FileHeader& header) {
  constexpr std::uint64_t endMark = 8;
  const std::uint64_t length = s.dataSet.pixels->length, needed = header.format.allBytes();
  const bool isNative = header.syntax.coding == Coding::native;
  if (isNative && length > needed + needed % 2 && length >= needed + header.format.frameBytes())
    header.warnings.push_back("its pixel data has " + std::to_string(length) + " bytes, and its " +
                              std::to_string(header.format.frames) +
                              (header.format.frames == 1 ? " frame" : " frames") + " take " +
                              std::to_string(needed) + ": the rest is not shown");
  if (const Range last = frames.back().back(); !isNative && last.offset + last.length + endMark > s.size)
    header.warnings.emplace_back("it ends behind its last fragment, without the mark that belongs there");
}

/// Returns the bytes of each frame.
Result<std::vector<FrameRanges>> findFrames(const RegularFile& file, const ScannedFile& s,
                                            const DataSet& data, FileHeader& header) {
  const Element& pixels = *s.dataSet.pixels;
  const bool isNative = header.syntax.coding == Coding::native,
             inFragments = pixels.length == undefinedLength;
  const std::string named = "\"" + std::string(header.syntax.name) + "\"";
  if (isNative && inFragments)
    return Error{"its pixel data is in fragments, which " + named +
                 " does not have, and they hold no picture that is known"};
  if (!isNative && !inFragments)
    return Error{"its pixel data is not in fragments, as " + named + " wants it"};
  auto frames = isNative ? nativeFrames(pixels, header.format, s.size)
                         : encapsulatedFrames(file, pixels, header.format.frames);
  if (!frames) return frames;
  if (!isNative && data.number(0x00280008, data.root()) == 0.0 && frames->front().size() > 1)
    return Error{"NumberOfFrames is 0, and its pixel data is in " + std::to_string(frames->front().size()) +
                 " fragments: which of them make a frame is not known"};
  tellLength(s, *frames, header);
  return frames;
}

}  // namespace

Status readPicture(const RegularFile& file, const ScannedFile& s, const DataSet& data, FileHeader& header) {
  if (Status read = readFormat(file, s, data, header); !read) return read;
  const PixelFormat& format = header.format;
  if (header.syntax.coding == Coding::unsupported)
    return Error{"its transfer syntax \"" + std::string(header.syntax.name) + "\" is not supported"};
  if (format.framePixels() > framePixelLimit()) return tooLarge(format.framePixels());
  if (format.isBits() && header.syntax.coding != Coding::native)
    return Error{"its bits are compressed (" + std::string(header.syntax.name) + "), which is not read"};
  if (format.allBytes() > sizeLimit) return Error{"it claims more than 16 GiB of pixels"};
  if (Status slices = readSlices(data, header); !slices) return slices;
  auto frames = findFrames(file, s, data, header);
  if (!frames) return frames.error();
  header.frames = std::move(*frames);
  header.cine = readCine(data, format.frames);
  header.contrastAgent = readContrastAgent(data);
  splitMosaic(data, header);
  return {};
}

std::string instanceId(const FileHeader& file) {
  return file.sopInstanceUid.empty() ? fileName(file.path) : file.sopInstanceUid;
}

InspectedFile inspectFile(const std::string& path) {
  InspectedFile file;
  file.found = inspectInto(path, file.scanned);
  return file;
}

Inspection inspect(const std::string& path) { return inspectFile(path).found; }

}  // namespace volumen::dicom
