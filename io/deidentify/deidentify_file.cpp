#include "io/deidentify/deidentify_file.h"

#include <algorithm>
#include <set>

#include "io/deidentify/copied_pixels.h"
#include "io/deidentify/rewrite_data_set.h"
#include "io/dicom/csa.h"
#include "io/dicom/data_set.h"
#include "io/dicom/scanned_file.h"
#include "io/export/dicom_file.h"
#include "io/regular_file.h"
#include "io/study/faces.h"
#include "io/worker/batches.h"

namespace volumen {

static void fields(worker::Wire& w, FilePart& part) { w(part.offset, part.length, part.bytes, part.kept); }
static void fields(worker::Wire& w, Retained& r) {
  w(r.uids, r.dates, r.device, r.institution, r.patient, r.descriptors, r.privates, r.shiftDays);
}
static void fields(worker::Wire& w, Deidentification& d) { w(d.retained, d.key, d.deface); }
static void fields(worker::Wire& w, DeidentifiedFile& f) {
  w(f.parts, f.transferSyntax, f.sopClass, f.studyUid, f.seriesUid, f.instanceUid, f.modality, f.mayShowText,
    f.mayShowFace, f.hasLostSuv, f.hasLostMosaic, f.encoding.explicitVr, f.encoding.bigEndian, f.words);
}

namespace {

using dicom::DataSet;
using dicom::Encoding;
using dicom::ScannedFile;

constexpr const char* inflatedSyntax = "1.2.840.10008.1.2.1";
// These identify the program that wrote a file (PS3.10 7.1).
constexpr const char* implementationClassUid = "2.25.201107755137305124765928151552104590321";
constexpr const char* implementationVersionName = "VOLUMEN";

// Returns the reason why a class cannot be cleaned; empty if it can.
std::string problemOfClass(const std::string& sopClass) {
  if (sopClass == "1.2.840.10008.1.3.10") return "it is a DICOMDIR, which lists names of files and patients";
  if (sopClass.starts_with("1.2.840.10008.5.1.4.1.1.104."))
    return "it holds a document (PDF, CDA, STL), which cannot be cleaned";
  if (!sopClass.starts_with("1.2.840.10008."))
    return sopClass.empty() ? "it has no SOP class"
                            : "it is of a manufacturer's own class, which cannot be cleaned";
  return "";
}

void notePixels(const DataSet& data, const Retained& retained, DeidentifiedFile& file) {
  const auto text = [&](std::uint32_t tag) { return data.text(tag, data.root()); };
  file.modality = text(0x00080060);
  const std::string burnedIn = text(0x00280301);
  static const std::set<std::string> oftenWithText = {"US", "SC", "OT", "XA", "RF",  "ES",
                                                      "XC", "GM", "SM", "OP", "IVUS"};
  const bool isOften = oftenWithText.contains(file.modality);
  file.mayShowText = burnedIn == "YES" || (isOften && burnedIn != "NO");
  const std::string part = text(0x00180015) + " " + text(0x00081030) + " " + text(0x0008103e);
  file.mayShowFace = text(0x00280302) == "YES" || mayShowFace(file.modality, part);
  file.hasLostSuv =
      file.modality == "PT" && !(retained.patient && (retained.dates || retained.shiftDays != 0));
  const std::vector<std::string> types = data.values(0x00080008, data.root());
  file.hasLostMosaic =
      std::ranges::find(types, "MOSAIC") != types.end() && !dicom::readCsaImageHeader(data).empty();
}

// Returns the number of pixels of a single-frame grey image of 16 bits; 0 for all other pixels.
std::size_t wordsOfPixels(const DataSet& data) {
  const auto word = [&](std::uint32_t tag) { return int(data.word(tag, data.root()).value_or(0)); };
  const int allocated = word(0x00280100), stored = word(0x00280101), highBit = word(0x00280102);
  const bool isOneFrame = data.number(0x00280008, data.root()).value_or(1) == 1;
  const bool isGrey = word(0x00280002) == 1 && allocated == 16 && highBit + 1 == stored && isOneFrame;
  return isGrey ? std::size_t(word(0x00280010)) * std::size_t(word(0x00280011)) : 0;
}

Status rewrite(const ScannedFile& s, const RegularFile& file, const Rewriting& how,
               const Pseudonyms& pseudonyms, DeidentifiedFile& out) {
  const Encoding encoding = s.syntax.encoding;
  FileParts parts(s.head, s.inflatedFrom == 0);
  if (Status done = rewriteDataSet({s.head, s.dataSet.elements, encoding}, how, pseudonyms, parts); !done)
    return done;
  if (!how.isFaceless) {
    const auto pixels = addPixels(s, file, parts);
    if (!pixels) return pixels.error();
    out.mayShowText = out.mayShowText || pixels->keepOverlays;
  }
  out.parts = std::move(parts).take();
  return {};
}

Result<DeidentifiedFile> deidentifiedHere(const std::string& path, const Deidentification& how,
                                          bool isFaceless) {
  worker::needAll();
  const Result<RegularFile> file = RegularFile::open(path);
  if (!file) return file.error();
  ScannedFile s;
  if (Status read = s.readMeta(*file); !read) return read.error();
  const Status scanned = s.scan(*file);
  const DataSet data(s.head, s.dataSet.elements);
  const Pseudonyms pseudonyms(how.key, how.deface);
  const auto uid = [&](std::uint32_t tag) {
    const std::string old = data.text(tag, data.root());
    return how.retained.uids ? old : pseudonyms.uid(old);
  };
  DeidentifiedFile out;
  out.sopClass = data.text(0x00080016, data.root());
  if (!s.meta.magic && (!scanned || out.sopClass.empty())) return Error{noDicomFile};
  if (!scanned) return scanned.error();
  if (const std::string problem = problemOfClass(out.sopClass); !problem.empty()) return Error{problem};
  out.studyUid = uid(0x0020000d), out.seriesUid = uid(0x0020000e), out.instanceUid = uid(0x00080018);
  if (out.studyUid.empty() || out.seriesUid.empty() || out.instanceUid.empty())
    return Error{"it lacks the UID of its study, series or instance"};
  const auto syntax = s.syntaxOfBytes();
  if (!syntax) return syntax.error();
  out.transferSyntax = s.syntax.deflated ? inflatedSyntax : *syntax;
  out.encoding = s.syntax.encoding;
  out.words = wordsOfPixels(data);
  notePixels(data, how.retained, out);
  if (Status done = rewrite(s, *file, {how.retained, isFaceless}, pseudonyms, out); !done)
    return done.error();
  return out;
}

// Returns the preamble and the file meta information (PS3.10 7.1).
std::string metaOf(const DeidentifiedFile& file) {
  constexpr std::uint32_t mediaClass = 0x00020002, mediaInstance = 0x00020003, syntax = 0x00020010,
                          implementation = 0x00020012, implementationName = 0x00020013;
  constexpr std::size_t preamble = 128;
  FileParts group({}, true);
  const Encoding plain;
  const std::uint16_t ui = dicom::vrOf('U', 'I');
  group.addElement(plain, 0x00020001, dicom::vrOf('O', 'B'), std::string_view("\0\1", 2));
  group.addElement(plain, mediaClass, ui, file.sopClass);
  group.addElement(plain, mediaInstance, ui, file.instanceUid);
  group.addElement(plain, syntax, ui, file.transferSyntax);
  group.addElement(plain, implementation, ui, implementationClassUid);
  group.addElement(plain, implementationName, dicom::vrOf('S', 'H'), implementationVersionName);
  const std::string elements = std::move(group).take().front().bytes;
  FileParts meta({}, true);
  meta.add(std::string(preamble, '\0') + "DICM");
  std::string length;
  for (int shift = 0; shift < 32; shift += 8) length += char(elements.size() >> shift & 0xff);
  meta.addElement(plain, 0x00020000, dicom::vrOf('U', 'L'), length);
  meta.add(elements);
  return std::move(meta).take().front().bytes;
}

// Calls take(bytes) for all bytes of the written file in order, until it fails.
template <class Take>
Status forEachPart(const DeidentifiedFile& file, const std::string& source, const Take& take) {
  const Result<RegularFile> from = RegularFile::open(source);
  if (!from) return Error{source + " cannot be read: " + from.message() + "."};
  if (Status s = take(metaOf(file)); !s) return s;
  constexpr std::uint64_t most = 8 << 20;
  for (const FilePart& part : file.parts) {
    if (!part.bytes.empty())
      if (Status s = take(part.bytes); !s) return s;
    const std::uint64_t end = part.offset + part.length;
    for (std::uint64_t at = part.offset; part.bytes.empty() && at < end; at += most) {
      auto bytes = from->read(at, std::min(most, end - at));
      if (!bytes) return Error{source + " cannot be read: " + bytes.message() + "."};
      clearBits(std::span(*bytes), part.kept);
      if (Status s = take({reinterpret_cast<const char*>(bytes->data()), bytes->size()}); !s) return s;
    }
  }
  return {};
}

}  // namespace

namespace {

Result<DeidentifiedFile> rewritten(const std::string& path, const Deidentification& how, bool isFaceless,
                                   const CancelToken& cancel) {
  worker::Request request = worker::headersOf({path}, cancel);
  worker::Failure failure{};
  return worker::isolated<deidentifiedHere>(request, failure, path, how, isFaceless);
}

// Returns 16-bit values as bytes.
std::string bytesOf(const std::vector<std::uint16_t>& words, bool bigEndian) {
  std::string bytes;
  bytes.reserve(2 * words.size());
  for (const std::uint16_t word : words)
    for (const int shift : {bigEndian ? 8 : 0, bigEndian ? 0 : 8}) bytes += char(word >> shift & 0xff);
  return bytes;
}

}  // namespace

Result<DeidentifiedFile> deidentifiedFile(const std::string& path, const Deidentification& how,
                                          const CancelToken& cancel) {
  return rewritten(path, how, false, cancel);
}

Result<DeidentifiedFile> facelessFile(const std::string& path, const StoredSlice& pixels,
                                      const Deidentification& how, const CancelToken& cancel) {
  auto file = rewritten(path, how, true, cancel);
  if (!file) return file;
  if (file->words != pixels.words.size()) return Error{"its pixels are not one frame of 16 bits"};
  const dicom::Encoding encoding = file->encoding;
  FileParts parts({}, true);
  parts.addElement(encoding, 0x7fe00010, dicom::vrOf('O', 'W'), bytesOf(pixels.words, encoding.bigEndian));
  for (FilePart& part : std::move(parts).take()) file->parts.push_back(std::move(part));
  const bool isPlain = file->transferSyntax == "1.2.840.10008.1.2" || encoding.bigEndian;
  if (!isPlain) file->transferSyntax = inflatedSyntax;
  file->mayShowFace = false;
  return file;
}

bool isWrittenAt(const DeidentifiedFile& file, const std::string& source, const std::string& path) {
  const auto there = RegularFile::open(path);
  if (!there) return false;
  std::uint64_t at = 0;
  const Status same = forEachPart(file, source, [&](std::string_view bytes) {
    const auto found = there->read(at, bytes.size());
    at += bytes.size();
    const bool isSame = found && std::equal(bytes.begin(), bytes.end(), found->begin(), found->end(),
                                            [](char a, std::uint8_t b) { return std::uint8_t(a) == b; });
    return isSame ? Status() : Status(Error{"other bytes"});
  });
  return same && at == there->size();
}

Status writeDeidentified(const DeidentifiedFile& file, const std::string& source, const std::string& to) {
  auto out = createNew(to);
  if (!out) return out.error();
  if (Status s = forEachPart(file, source, [&](std::string_view bytes) { return out->write(bytes); }); !s)
    return s;
  return commitNew(*out, to);
}

}  // namespace volumen
