#include "io/dicom/header.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include "io/dicom/attributes.h"
#include "io/dicom/inflate.h"

namespace volumen::dicom {
namespace {

constexpr std::uint64_t firstRead = 64 << 10;
constexpr std::uint64_t headerLimit = 512 << 20;
constexpr std::uint64_t sizeLimit = std::uint64_t(16) << 30;

Inspection refused(const std::string& reason) {
  std::string sentence = reason + ".";
  return {Inspection::Kind::refused, sentence, {}};
}

/// A scanned file: its first bytes (all of an inflated data set) and the elements in them.
struct Scanned {
  MetaHeader meta;
  TransferSyntax syntax;
  std::vector<std::uint8_t> head;
  std::uint64_t size = 0;  // of what offsets of elements count in
  std::uint64_t inflatedFrom = 0;
  DataSetScan dataSet;
};

/// The transfer syntax that the file names, with the encoding that its bytes show.
Result<TransferSyntax> syntaxOf(const MetaHeader& meta, Bytes head) {
  TransferSyntax syntax = transferSyntax(meta.transferSyntaxUid);
  if (meta.transferSyntaxUid.empty()) syntax = transferSyntax("1.2.840.10008.1.2");
  if (!*syntax.uid)
    return Error{"its transfer syntax " + toUtf8(meta.transferSyntaxUid, {}) + " is not known"};
  if (!syntax.deflated) syntax.encoding = encodingFound(head, meta.dataSet, syntax.encoding);
  return syntax;
}

Status scanInflated(const RegularFile& file, Scanned& s) {
  if (Status read = file.readUpTo(s.head, file.size()); !read) return read;
  auto inflated = inflateRaw(Bytes(s.head).subspan(s.meta.dataSet));
  if (!inflated) return inflated.error();
  s.inflatedFrom = s.meta.dataSet;
  s.head = std::move(*inflated);
  s.size = s.head.size();
  auto scan = scanDataSet(s.head, 0, s.size, s.syntax.encoding);
  if (!scan) return scan.error();
  s.dataSet = std::move(*scan);
  return {};
}

Status scanPlain(const RegularFile& file, Scanned& s) {
  s.size = file.size();
  while (true) {
    auto scan = scanDataSet(s.head, s.meta.dataSet, s.size, s.syntax.encoding);
    if (!scan) return scan.error();
    s.dataSet = std::move(*scan);
    if (!s.dataSet.needsUpTo) return {};
    if (s.dataSet.needsUpTo > headerLimit) return Error{"it has more than 512 MiB in front of its pixels"};
    if (Status read = file.readUpTo(s.head, std::max<std::uint64_t>(s.dataSet.needsUpTo, 4 * s.head.size()));
        !read)
      return read;
  }
}

/// "DICOM file without pixel data (SR)".
std::string kindOf(const FileHeader& header) {
  const char* name = header.sopClassUid.empty() ? nullptr : dcmFindNameOfUID(header.sopClassUid.c_str());
  if (header.sopClassUid == "1.2.840.10008.1.3.10" ||
      (name && std::string_view(name) == "MediaStorageDirectoryStorage"))
    return "DICOMDIR";
  const std::string known = !header.modality.empty() ? header.modality : name ? name : "";
  return "DICOM file without pixel data" + (known.empty() ? "" : " (" + known + ")");
}

Result<std::vector<FrameRanges>> nativeFrames(const Element& pixels, const PixelFormat& format,
                                              std::uint64_t size) {
  const std::uint64_t needed = format.frameBytes() * std::uint64_t(format.frames);
  const std::uint64_t have = std::min(pixels.length, size - std::min(size, pixels.offset));
  if (pixels.length == undefinedLength) return Error{"its pixel data has no length"};
  if (have < needed)
    return Error{"its pixel data is cut off: " + std::to_string(have) + " of " + std::to_string(needed) +
                 " bytes are there"};
  std::vector<FrameRanges> frames;
  for (int n = 0; n < format.frames; ++n)
    frames.push_back({{pixels.offset + std::uint64_t(n) * format.frameBytes(), format.frameBytes()}});
  return frames;
}

Status readPicture(const RegularFile& file, const Scanned& s, const DataSet& data, FileHeader& header) {
  if (header.sopClassUid == "1.2.840.10008.5.1.4.1.1.66.4")
    return Error{"DICOM segmentation: not supported yet"};
  const Element& pixels = *s.dataSet.pixels;
  auto format = readPixelFormat(data, pixels);
  if (!format) return format.error();
  header.format = *format;
  if (s.syntax.coding == Coding::unsupported)
    return Error{"its transfer syntax \"" + std::string(s.syntax.name) + "\" is not supported"};
  if (format->frameBytes() * std::uint64_t(format->frames) > sizeLimit)
    return Error{"it claims more than 16 GiB of pixels"};
  if (Status slices = readSlices(data, header); !slices) return slices;
  if (s.syntax.coding != Coding::native && pixels.length != undefinedLength)
    return Error{"its pixel data is not in fragments, as \"" + std::string(s.syntax.name) + "\" wants it"};
  auto frames = s.syntax.coding == Coding::native ? nativeFrames(pixels, *format, s.size)
                                                  : encapsulatedFrames(file, pixels, format->frames);
  if (!frames) return frames.error();
  header.frames = std::move(*frames);
  return {};
}

/// Whether a file without preamble begins as DICOM does: with group 0002, 0004 or 0008 in either byte order.
bool beginsAsDicom(Bytes head) {
  if (head.size() < 8) return false;
  const std::uint16_t group = numberAt<std::uint16_t>(head, 0, false);
  return group == 0x0002 || group == 0x0004 || group == 0x0008 || group == 0x0800;
}

}  // namespace

Inspection inspect(const std::string& path) {
  const Result<RegularFile> file = RegularFile::open(path);
  if (!file) return refused(file.message());
  Scanned s;
  if (Status read = file->readUpTo(s.head, firstRead); !read) return refused(read.message());
  const Result<MetaHeader> meta = scanMeta(s.head, file->size());
  const bool magic = hasMagic(s.head);
  if (!magic && !beginsAsDicom(s.head)) return {};
  if (!meta) return magic ? refused(meta.message()) : Inspection{};
  s.meta = *meta;
  const Result<TransferSyntax> syntax = syntaxOf(s.meta, s.head);
  if (!syntax) return refused(syntax.message());
  s.syntax = *syntax;
  const Status scanned = s.syntax.deflated ? scanInflated(*file, s) : scanPlain(*file, s);
  const bool looksLikeDicom = magic || !s.meta.transferSyntaxUid.empty();
  if (!scanned) return looksLikeDicom ? refused(scanned.message()) : Inspection{};

  const DataSet data(s.head, s.dataSet.elements);
  // Without preamble only what says which class or kind it is passes for DICOM.
  const bool named = data.has(0x00080016, data.root()) || data.has(0x00080060, data.root());
  if (!looksLikeDicom && !named) return {};
  Inspection found{Inspection::Kind::picture, {}, {}};
  found.header.path = path;
  found.header.syntax = s.syntax;
  found.header.inflatedFrom = s.inflatedFrom;
  readIdentity(data, found.header);
  if (!s.dataSet.pixels) return {Inspection::Kind::noPicture, kindOf(found.header), {}};
  if (Status picture = readPicture(*file, s, data, found.header); !picture) return refused(picture.message());
  return found;
}

}  // namespace volumen::dicom
