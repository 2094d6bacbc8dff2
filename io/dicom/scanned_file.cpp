#include "io/dicom/scanned_file.h"

#include <algorithm>

#include "io/dicom/data_set.h"
#include "io/dicom/inflate.h"

namespace volumen::dicom {

namespace {
constexpr std::uint64_t firstRead = 64 << 10;
constexpr std::uint64_t headerLimit = 512 << 20;
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

Status ScannedFile::scan(const RegularFile& file) {
  return syntax.deflated ? scanInflated(file) : scanPlain(file);
}

Status ScannedFile::scanInflated(const RegularFile& file) {
  if (Status read = file.readUpTo(head, file.size()); !read) return read;
  auto inflated = inflateRaw(Bytes(head).subspan(meta.dataSet));
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
