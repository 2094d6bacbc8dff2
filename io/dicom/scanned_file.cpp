#include "io/dicom/scanned_file.h"

#include <algorithm>

#include "io/dicom/codestream.h"
#include "io/dicom/data_set.h"
#include "io/dicom/inflate.h"

namespace volumen::dicom {

namespace {
constexpr std::uint64_t firstRead = 64 << 10;
constexpr std::uint64_t headerLimit = 512 << 20;

/// Returns the first bytes of the first fragment that is not empty, after the offset table.
Result<std::vector<std::uint8_t>> firstFragment(const RegularFile& file, std::uint64_t offset,
                                                std::uint64_t enough) {
  constexpr int mostItems = 4;
  constexpr std::uint64_t itemHeader = 8;
  for (int n = 0; n < mostItems && offset + itemHeader <= file.size(); ++n) {
    const auto header = file.read(offset, itemHeader);
    if (!header) return header.error();
    const std::uint64_t length = numberAt<std::uint32_t>(*header, 4, false);
    offset += itemHeader;
    if (length > file.size() - offset) break;
    if (n > 0 && length > 0) return file.read(offset, std::min(length, enough));
    offset += length;
  }
  return std::vector<std::uint8_t>();
}
}  // namespace

Status ScannedFile::begin(const RegularFile& file) { return file.readUpTo(head, firstRead); }

Status ScannedFile::findSyntax() {
  syntax = transferSyntax(meta.transferSyntaxUid);
  if (meta.transferSyntaxUid.empty()) syntax = transferSyntax("1.2.840.10008.1.2");
  if (!*syntax.uid)
    return Error{"its transfer syntax " + toUtf8(meta.transferSyntaxUid, {}) + " is not known"};
  if (!syntax.deflated) syntax.encoding = encodingFound(head, meta.dataSet, syntax.encoding);
  return {};
}

Status ScannedFile::readMeta(const RegularFile& file) {
  if (Status read = begin(file); !read) return read;
  const Result<MetaHeader> found = scanMeta(head, file.size());
  if (!found) return found.error();
  meta = *found;
  return findSyntax();
}

Status ScannedFile::scan(const RegularFile& file) {
  if (Status scanned = syntax.deflated ? scanInflated(file) : scanPlain(file); !scanned) return scanned;
  return correctSyntax(file);
}

Status ScannedFile::correctSyntax(const RegularFile& file) {
  const bool inFragments = dataSet.pixels && dataSet.pixels->length == undefinedLength;
  if (!inFragments || inflatedFrom || dataSet.pixels->bigEndian || syntax.coding == Coding::unsupported)
    return {};
  const auto isJpeg = [](Coding coding) { return coding == Coding::jpeg || coding == Coding::jpegLs; };
  constexpr std::uint64_t mark = 64, frameHeader = 64 << 10;  // bytes to search for them
  const auto begin = firstFragment(file, dataSet.pixels->offset, isJpeg(syntax.coding) ? mark : frameHeader);
  if (!begin) return begin.error();
  const TransferSyntax found = transferSyntax(syntaxOfStream(*begin));
  if (!*found.uid || found.coding == syntax.coding || (isJpeg(found.coding) && isJpeg(syntax.coding)))
    return {};
  remark = "its transfer syntax is \"" + std::string(syntax.name) +
           "\", and its pixels are compressed as \"" + found.name + "\": they were read as such";
  const Encoding encoding = syntax.encoding;
  syntax = found;
  syntax.encoding = encoding;
  return {};
}

Result<std::string> ScannedFile::syntaxOfBytes() const {
  const TransferSyntax named = transferSyntax(meta.transferSyntaxUid);
  const Encoding found = syntax.encoding;
  const bool isNative = !*named.uid || (named.coding == Coding::native && !named.deflated);
  if (!isNative) {
    if (named.deflated ||
        (named.encoding.explicitVr == found.explicitVr && named.encoding.bigEndian == found.bigEndian))
      return std::string(named.uid);
    return Error{"it is not encoded as its transfer syntax says"};
  }
  if (dataSet.pixels && dataSet.pixels->length == undefinedLength)
    return Error{"its pixels are compressed, but its transfer syntax says that they are not"};
  if (!found.explicitVr && found.bigEndian) return Error{"it is encoded in no transfer syntax"};
  if (!found.explicitVr) return std::string("1.2.840.10008.1.2");
  return std::string(found.bigEndian ? "1.2.840.10008.1.2.2" : "1.2.840.10008.1.2.1");
}

Status ScannedFile::scanInflated(const RegularFile& file) {
  if (Status read = file.readUpTo(head, file.size()); !read) return read;
  auto inflated = inflateAll(Bytes(head).subspan(meta.dataSet));
  if (!inflated) return inflated.error();
  inflatedFrom = meta.dataSet;
  head = std::move(*inflated);
  size = head.size();
  auto found = scanDataSet(head, 0, size, syntax.encoding, &dataSet);
  if (!found) return found.error();
  dataSet = std::move(*found);
  return {};
}

Status ScannedFile::scanPlain(const RegularFile& file) {
  size = file.size();
  while (true) {
    auto found = scanDataSet(head, meta.dataSet, size, syntax.encoding, &dataSet);
    if (!found) return found.error();
    dataSet = std::move(*found);
    if (!dataSet.needsUpTo) return {};
    if (dataSet.needsUpTo > headerLimit) return Error{"it has more than 512 MiB in front of its pixels"};
    if (Status read = file.readUpTo(head, std::max<std::uint64_t>(dataSet.needsUpTo, 4 * head.size())); !read)
      return read;
  }
}

}  // namespace volumen::dicom
