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

Inspection refused(const std::string& reason) {
  std::string sentence = reason + ".";
  return {Inspection::Kind::refused, sentence, {}, {}, {}};
}

Error tooLarge(std::uint64_t framePixels) {
  return {"a frame of it has " + std::to_string(framePixels / 1'000'000) + " million pixels; more than " +
          framePixelLimitText() + " are only read with --largest-frame"};
}

/// "DICOM file without pixel data (SR)".
std::string kindOf(const FileHeader& header) {
  const char* name = header.sopClassUid.empty() ? nullptr : dcmFindNameOfUID(header.sopClassUid.c_str());
  const std::string known = !header.modality.empty() ? header.modality : name ? name : "";
  return "DICOM file without pixel data" + (known.empty() ? "" : " (" + known + ")");
}

/// The 16-bit words in which each frame's bits lie; frames share those at their ends.
Result<std::vector<FrameRanges>> bitFrames(std::uint64_t offset, const PixelFormat& format,
                                           std::uint64_t have) {
  if (format.bytesInWords && have % 2 == 1 && have == format.allBytes())
    return Error{"its bits end within a big endian word"};
  std::vector<FrameRanges> frames;
  for (std::uint64_t n = 0; n < std::uint64_t(format.frames); ++n) {
    const std::uint64_t begin = n * format.frameSamples() / 16 * 2;
    const std::uint64_t end = std::min(((n + 1) * format.frameSamples() + 15) / 16 * 2, have);
    frames.push_back({{offset + begin, end - begin}});
  }
  return frames;
}

Result<std::vector<FrameRanges>> nativeFrames(const Element& pixels, const PixelFormat& format,
                                              std::uint64_t size) {
  const std::uint64_t needed = format.allBytes();
  const std::uint64_t have = std::min(pixels.length, size - std::min(size, pixels.offset));
  if (pixels.length == undefinedLength) return Error{"its pixel data has no length"};
  if (have < needed)
    return Error{"its pixel data is cut off: " + std::to_string(have) + " of " + std::to_string(needed) +
                 " bytes are there"};
  if (format.isBits()) return bitFrames(pixels.offset, format, have);
  // The last byte of an odd number stands behind its padding.
  const bool oddWords = format.bytesInWords && format.frameBytes() % 2 == 1;
  if (oddWords && (format.frames > 1 || have == needed))
    return Error{"its frames have an odd number of bytes in big endian words"};
  if (oddWords) return std::vector<FrameRanges>{{{pixels.offset, needed + 1}}};
  std::vector<FrameRanges> frames;
  for (int n = 0; n < format.frames; ++n)
    frames.push_back({{pixels.offset + std::uint64_t(n) * format.frameBytes(), format.frameBytes()}});
  return frames;
}

/// Whether a file without preamble begins as DICOM does: with group 0002, 0004 or 0008 in either byte order.
bool beginsAsDicom(Bytes head) {
  if (head.size() < 8) return false;
  const std::uint16_t group = numberAt<std::uint16_t>(head, 0, false);
  return group == 0x0002 || group == 0x0004 || group == 0x0008 || group == 0x0800;
}

/// Whose a file without a picture is, and where that would lie.
void keepIdentity(const DataSet& data, const FileHeader& header, Inspection& found) {
  static_cast<SeriesIdentity&>(found.header) = header;
  const auto at = data.numbers(0x00200032, data.root());
  if (at && at->size() == 3) found.position = glm::dvec3((*at)[0], (*at)[1], (*at)[2]);
}

/// A refusal that keeps what is known of the file.
Inspection refused(const std::string& reason, const DataSet& data) {
  Inspection found = refused(reason);
  FileHeader header;
  readIdentity(data, header);
  keepIdentity(data, header, found);
  return found;
}

/// Whether a file holds the beginning of an empty preamble: what is left where a copy broke off.
bool isBrokenOff(Bytes head) {
  std::array<std::uint8_t, 132> preamble{};
  std::memcpy(preamble.data() + 128, "DICM", 4);
  return head.size() < preamble.size() && std::equal(head.begin(), head.end(), preamble.begin());
}

/// What has no picture of its own, and what it refers to.
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

/// Reads the file and says what it is; leaves its elements in `s`.
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
  // Without preamble only what says which class or kind it is passes for DICOM.
  const bool named = data.has(0x00080016, data.root()) || data.has(0x00080060, data.root());
  if (!looksLikeDicom && !named) return {};
  Inspection found{Inspection::Kind::picture, {}, {}, {}, {}};
  found.header.path = path;
  found.header.syntax = s.syntax;
  found.header.inflatedFrom = s.inflatedFrom;
  readIdentity(data, found.header);
  if (found.header.modality == "PT") found.header.pet = readPetFacts(data);
  const bool isSegmentation = derivedKind(found.header.sopClassUid) == DerivedKind::segmentation;
  if (!s.dataSet.pixels || isSegmentation) return withoutPicture(data, found.header);
  if (Status picture = readPicture(*file, s, data, found.header); !picture)
    return refused(picture.message(), data);
  std::ranges::copy(data.remarks(), std::back_inserter(found.header.warnings));
  return found;
}

}  // namespace

Status readPicture(const RegularFile& file, const ScannedFile& s, const DataSet& data, FileHeader& header) {
  const Element& pixels = *s.dataSet.pixels;
  auto format = readPixelFormat(data, pixels);
  if (!format) return format.error();
  header.format = *format;
  if (!data.has(0x00280004, data.root()))
    header.warnings.emplace_back(
        "its PhotometricInterpretation is missing: one sample a pixel is taken as grey, high values bright");
  header.format.subsampled = s.syntax.coding == Coding::native && format->photometric == "YBR_FULL_422";
  if (header.format.subsampled && format->columns % 2 == 1)
    return Error{"its rows are odd, and YBR_FULL_422 stores two pixels at a time"};
  if (s.syntax.coding == Coding::unsupported)
    return Error{"its transfer syntax \"" + std::string(s.syntax.name) + "\" is not supported"};
  if (format->framePixels() > framePixelLimit()) return tooLarge(format->framePixels());
  if (header.format.isBits() && s.syntax.coding != Coding::native)
    return Error{"its bits are compressed (" + std::string(s.syntax.name) + "), which is not read"};
  if (header.format.allBytes() > sizeLimit) return Error{"it claims more than 16 GiB of pixels"};
  if (Status slices = readSlices(data, header); !slices) return slices;
  if (s.syntax.coding != Coding::native && pixels.length != undefinedLength)
    return Error{"its pixel data is not in fragments, as \"" + std::string(s.syntax.name) + "\" wants it"};
  auto frames = s.syntax.coding == Coding::native ? nativeFrames(pixels, header.format, s.size)
                                                  : encapsulatedFrames(file, pixels, format->frames);
  if (!frames) return frames.error();
  if (const std::uint64_t needed = header.format.allBytes();
      s.syntax.coding == Coding::native && pixels.length > needed + needed % 2 &&
      pixels.length >= needed + header.format.frameBytes())
    header.warnings.push_back("its pixel data has " + std::to_string(pixels.length) + " bytes, and its " +
                              std::to_string(format->frames) + (format->frames == 1 ? " frame" : " frames") +
                              " take " + std::to_string(needed) + ": the rest is not shown");
  header.cine = readCine(data, format->frames);
  header.contrastAgent = readContrastAgent(data);
  header.frames = std::move(*frames);
  constexpr std::uint64_t endMark = 8;
  if (const Range last = header.frames.back().back();
      s.syntax.coding != Coding::native && last.offset + last.length + endMark > s.size)
    header.warnings.emplace_back("it ends behind its last fragment, without the mark that belongs there");
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
