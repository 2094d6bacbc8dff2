#include "io/dicom/stored_data_set.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcistrmb.h>
#include <dcmtk/dcmdata/dcostrmb.h>
#include <dcmtk/dcmdata/dcwcache.h>
#include <dcmtk/dcmdata/dcxfer.h>

#include <algorithm>
#include <cstring>

#include "io/dicom/data_set.h"
#include "io/dicom/decode.h"
#include "io/dicom/fragments.h"
#include "io/dicom/native_pixels.h"
#include "io/dicom/scanned_file.h"
#include "io/regular_file.h"
#include "io/worker/batches.h"

namespace volumen::dicom {

static void fields(worker::Wire& w, StoredDataSet& stored) {
  w(stored.syntax, stored.begin, stored.end, stored.nativeBytes);
}

namespace {

// An uncompressed value has a length of 32 bits.
constexpr std::uint64_t mostNativeBytes = std::uint64_t(4) << 30;
constexpr std::uint64_t mostTail = 64 << 20;

// Returns where the elements end that are no DataSetTrailingPadding.
std::uint64_t endWithoutPadding(const DataSetScan& scan) {
  constexpr std::uint32_t trailingPadding = 0xfffcfffc;
  for (std::size_t n = 0; n < scan.elements.size(); n = scan.elements[n].end)
    if (const Element& e = scan.elements[n]; e.tag == trailingPadding)
      return e.offset - (e.vr == vrOf('O', 'B') || e.vr == vrOf('O', 'W') ? 12 : 8);
  return scan.end;
}

// Returns where a data set that has pixels ends.
Result<std::uint64_t> endBehindPixels(const RegularFile& file, const ScannedFile& s) {
  const Element& pixels = *s.dataSet.pixels;
  std::uint64_t at = pixels.offset + pixels.length;
  if (pixels.length == undefinedLength) {
    const auto end = endOfFragments(file, pixels);
    if (!end) return end.error();
    at = *end;
  }
  if (at > file.size()) return Error{"its pixels are cut off"};
  if (file.size() - at > mostTail) return Error{"it has more than 64 MiB behind its pixels"};
  const auto tail = file.read(at, file.size() - at);
  if (!tail) return tail.error();
  if (std::ranges::all_of(*tail, [](std::uint8_t byte) { return byte == 0; })) return at;
  const auto rest = scanDataSet(*tail, 0, tail->size(), s.syntax.encoding);
  if (!rest) return Error{"it has something else than elements behind its pixels"};
  if (rest->pixels) return Error{"it has pixels twice"};
  return at + endWithoutPadding(*rest);
}

std::uint64_t nativeBytes(const ScannedFile& s) {
  const DataSet data(s.head, s.dataSet.elements);
  std::uint64_t bytes = 1;
  for (const std::uint32_t tag : {0x00280002u, 0x00280010u, 0x00280011u})
    bytes *= data.word(tag, data.root()).value_or(0);
  const double frames = std::clamp(data.number(0x00280008, data.root()).value_or(1), 1.0, 1e9);
  const double all = double(bytes) * frames * std::max(1, data.word(0x00280100, data.root()).value_or(8) / 8);
  return std::uint64_t(std::min(all, 2.0 * double(mostNativeBytes)));
}

Result<StoredDataSet> storedDataSetHere(const std::string& path) {
  const Result<RegularFile> file = RegularFile::open(path);
  if (!file) return file.error();
  ScannedFile s;
  if (Status read = s.readMeta(*file); !read) return read.error();
  if (Status scanned = s.scan(*file); !scanned) return scanned.error();
  const auto syntax = s.syntaxOfBytes();
  if (!syntax) return syntax.error();
  Result<std::uint64_t> end = file->size();
  if (!s.syntax.deflated) end = s.dataSet.pixels ? endBehindPixels(*file, s) : endWithoutPadding(s.dataSet);
  if (!end) return end.error();
  return StoredDataSet{*syntax, s.meta.dataSet, *end, nativeBytes(s)};
}

std::vector<std::uint8_t> bytesIn(DcmDataset& data, E_TransferSyntax syntax) {
  std::vector<std::uint8_t> all, some(1 << 20);
  DcmWriteCache cache;
  data.transferInit();
  for (OFCondition done = EC_StreamNotifyClient; done == EC_StreamNotifyClient;) {
    DcmOutputBufferStream out(some.data(), offile_off_t(some.size()));
    done = data.write(out, syntax, EET_ExplicitLength, &cache, EGL_withoutGL, EPD_withoutPadding);
    void* bytes = nullptr;
    offile_off_t count = 0;
    out.flushBuffer(bytes, count);
    if (done.bad() && done != EC_StreamNotifyClient) return {};
    all.insert(all.end(), some.begin(), some.begin() + std::ptrdiff_t(count));
  }
  data.transferEnd();
  return all;
}

// Returns whether a transfer syntax is of a video (MPEG-2, MPEG-4, HEVC).
bool isVideo(const std::string& syntax) {
  constexpr const char* beforeNumber = "1.2.840.10008.1.2.4.10";
  return syntax.starts_with(beforeNumber) && syntax.size() > std::strlen(beforeNumber);
}

// DCMTK does not know HTJ2K, which is encoded as JPEG 2000 is.
E_TransferSyntax syntaxForDcmtk(const std::string& syntax) {
  const bool isJpeg2000 = transferSyntax(syntax).coding == Coding::jpeg2000;
  return isJpeg2000 ? EXS_JPEG2000LosslessOnly : DcmXfer(syntax.c_str()).getXfer();
}

// Makes the pixels of a data set native.
Status decompress(const RegularFile& file, const StoredDataSet& stored, E_TransferSyntax to,
                  DcmDataset& data) {
  if (isVideo(stored.syntax)) return Error{"volumen does not decompress videos"};
  ScannedFile s;
  if (Status read = s.readMeta(file); !read) return read;
  if (Status scanned = s.scan(file); !scanned) return scanned;
  if (s.dataSet.pixels && s.syntax.coding == Coding::jpeg2000) {
    if (Status put = putNativePixels(file, s, data); !put)
      return Error{"it cannot be decompressed: " + put.message()};
  } else if (data.chooseRepresentation(to, nullptr).bad()) {
    return Error{"it cannot be decompressed"};
  }
  // They are of fragments.
  for (const DcmTagKey& tag : {DCM_ExtendedOffsetTable, DCM_ExtendedOffsetTableLengths})
    data.findAndDeleteElement(tag);
  return {};
}

Result<std::vector<std::uint8_t>> inSyntaxHere(const std::string& path, const StoredDataSet& stored,
                                               const std::string& syntax) {
  worker::needAll();
  registerDecoders();
  const Result<RegularFile> file = RegularFile::open(path);
  if (!file) return file.error();
  const auto bytes = file->read(stored.begin, stored.end - stored.begin);
  if (!bytes) return bytes.error();
  DcmInputBufferStream in;
  in.setBuffer(bytes->data(), offile_off_t(bytes->size()));
  in.setEos();
  DcmDataset data;
  const E_TransferSyntax to = syntaxForDcmtk(syntax);
  data.transferInit();
  const OFCondition read = data.read(in, syntaxForDcmtk(stored.syntax));
  data.transferEnd();
  if (read.bad()) return Error{std::string("it cannot be read: ") + read.text()};
  if (syntax != stored.syntax)
    if (Status native = decompress(*file, stored, to, data); !native) return native.error();
  if (!data.canWriteXfer(to)) return Error{"it cannot be decompressed"};
  std::vector<std::uint8_t> all = bytesIn(data, to);
  if (all.empty()) return Error{"it cannot be converted"};
  return all;
}

}  // namespace

Result<StoredDataSet> storedDataSet(const std::string& path, const CancelToken& cancel) {
  worker::Request request = worker::headersOf({path}, cancel);
  worker::Failure failure{};
  return worker::isolated<storedDataSetHere>(request, failure, path);
}

Result<std::vector<std::uint8_t>> inSyntax(const std::string& path, const StoredDataSet& stored,
                                           const std::string& syntax, const CancelToken& cancel) {
  if (stored.nativeBytes > mostNativeBytes) return Error{"it is too large without compression"};
  worker::Request request = worker::headersOf({path}, cancel);
  request.needBytes += stored.nativeBytes + (stored.end - stored.begin);
  request.mostBytes += stored.nativeBytes + (stored.end - stored.begin);
  worker::Failure failure{};
  return worker::isolated<inSyntaxHere>(request, failure, path, stored, syntax);
}

}  // namespace volumen::dicom
