#include "io/export/secondary_capture.h"

#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmdata/dcrleenc.h>

#include <algorithm>
#include <cmath>

#include "io/export/dicom_file.h"
#include "io/study/series.h"

namespace volumen {

namespace {

constexpr int planes = 3;

void appendWord(std::vector<std::uint8_t>& bytes, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(std::uint8_t(value >> shift));
}

// Returns the header of an item: tag and length (PS3.5 A.4).
std::vector<std::uint8_t> itemHead(std::uint32_t tag, std::size_t length) {
  std::vector<std::uint8_t> bytes;
  appendWord(bytes, std::size_t(tag & 0xffff) << 16 | tag >> 16);
  appendWord(bytes, length);
  return bytes;
}

// Returns one frame as RLE (PS3.5 G): one plane for each colour, each row encoded by itself.
std::vector<std::uint8_t> rleFrame(std::span<const std::uint8_t> rgb, int columns) {
  constexpr std::size_t headWords = 16;
  std::vector<std::uint8_t> head, segments;
  appendWord(head, planes);
  const std::size_t rowBytes = std::size_t(columns) * planes;
  for (int plane = 0; plane < planes; ++plane) {
    appendWord(head, headWords * 4 + segments.size());
    DcmRLEEncoder encoder(1);
    for (std::size_t n = std::size_t(plane); n < rgb.size(); n += planes) {
      encoder.add(rgb[n]);
      if (n % rowBytes + planes >= rowBytes) encoder.flush();
    }
    if (encoder.fail()) throw std::bad_alloc();
    const std::size_t begin = segments.size();
    segments.resize(begin + encoder.size());
    encoder.write(segments.data() + begin);
  }
  while (head.size() < headWords * 4) appendWord(head, 0);
  head.insert(head.end(), segments.begin(), segments.end());
  return head;
}

DicomElements pixelModule(glm::ivec2 size) {
  return {{0x00280002, "3"},
          {0x00280004, "RGB"},
          {0x00280006, "0"},
          {0x00280010, std::to_string(size.y)},
          {0x00280011, std::to_string(size.x)},
          {0x00280100, "8"},
          {0x00280101, "8"},
          {0x00280102, "7"},
          {0x00280103, "0"}};
}

// Returns the modules Multi-frame and Cine.
DicomElements framesModule(int frames, double frameMs) {
  const std::string perSecond = std::to_string(std::max(1L, std::lround(1000 / frameMs)));
  return {{0x00280008, std::to_string(frames)},
          {0x00280009, "(0018,1063)"},
          {0x00181063, decimal(frameMs)},
          {0x00082144, perSecond},
          {0x00180040, perSecond},
          {0x00082142, "1"},
          {0x00082143, std::to_string(frames)},
          {0x00181244, "0"}};
}

// Returns the loss of earlier compressions, which stays declared (PS3.3 C.7.6.1.1.5).
DicomElements lossOf(const StudyObject& object) {
  DicomElements all = {{0x00282110, "00"}};
  if (object.valueOfSource(0x00282110) != "01") return all;
  for (const std::uint32_t tag : {0x00282110u, 0x00282112u, 0x00282114u})
    if (const std::string value = object.valueOfSource(tag); !value.empty()) all.push_back({tag, value});
  return all;
}

}  // namespace

Status checkCaptureFrames(const std::string& path, glm::ivec2 size, int frames, const CaptureTags& tags) {
  constexpr int most = 65535;
  constexpr double longest = 0xfffffffe;
  if (frames < 1 || size.x < 1 || size.y < 1 || size.x > most || size.y > most || !(tags.frameMs > 0))
    return Error{"Cannot write " + path +
                 ": a Secondary Capture has at least one frame, 1 to 65535 rows and " +
                 "columns, and a time from frame to frame above 0."};
  if (!tags.rle && double(size.x) * size.y * planes * frames > longest)
    return Error{"Cannot write " + path +
                 ": its frames are more than the 4 GB that a DICOM file holds uncompressed; write fewer or "
                 "smaller ones, or compress them (RLE)."};
  return {};
}

DicomElements captureElements(const StudyObject& object, const Series& series, const CaptureTags& tags,
                              std::span<const SourcePicture> pictures, glm::ivec2 size, int frames) {
  const ObjectTags& dated = object.tags();
  DicomElements all = {{0x00080008, "DERIVED\\SECONDARY"},
                       {0x00080023, dated.date},
                       {0x00080033, dated.time},
                       {0x00080064, "WSD"},
                       {0x00081090, "volumen"},
                       {0x00181000, "none"},
                       {0x00181012, dated.date},
                       {0x00181014, dated.time},
                       {0x00181016, "volumen"},
                       {0x00181018, "volumen"},
                       {0x00181019, "volumen " VOLUMEN_VERSION},
                       {0x00200013, "1"},
                       {0x00200020, ""},
                       {0x00280301, tags.hasNames ? "YES" : "NO"}};
  if (tags.showsFace) all.push_back({0x00280302, *tags.showsFace ? "YES" : "NO"});
  append(all, bodyPart(series));
  append(all, lossOf(object));
  append(all, derivation(firstCharacters(tags.derivation, 1024), pictures));
  append(all, pixelModule(size));
  if (frames > 1) append(all, framesModule(frames, tags.frameMs));
  return all;
}

SecondaryCapture::SecondaryCapture(OutputFile out, std::string path, glm::ivec2 size, int frames, bool rle)
    : out_(std::move(out)), path_(std::move(path)), size_(size), frames_(frames), rle_(rle) {}

Result<SecondaryCapture> SecondaryCapture::begin(const std::string& path, const Series& series,
                                                 const CaptureTags& tags, glm::ivec2 size, int frames,
                                                 const Progress& progress, const CancelToken& cancel) {
  if (Status s = checkCaptureFrames(path, size, frames, tags); !s) return s.error();
  auto out = createNew(path);
  if (!out) return out.error();
  const auto object = StudyObject::of(series, tags, progress, cancel, tags.slices);
  if (!object) return object.error();
  DcmFileFormat file;
  object->put(
      frames > 1 ? UID_MultiframeTrueColorSecondaryCaptureImageStorage : UID_SecondaryCaptureImageStorage,
      "OT", captureElements(*object, series, tags, object->pictures(), size, frames), *file.getDataset());
  const E_TransferSyntax syntax = tags.rle ? EXS_RLELossless : EXS_LittleEndianExplicit;
  if (Status s = writeDicomFile(file, *out, path, syntax); !s) return s.error();
  SecondaryCapture capture(std::move(*out), path, size, frames, tags.rle);
  if (Status s = capture.startPixels(); !s) return s.error();
  return capture;
}

Status SecondaryCapture::startPixels() {
  constexpr std::size_t undefined = 0xffffffff;
  std::vector<std::uint8_t> head = {0xe0, 0x7f, 0x10, 0x00, 'O', 'B', 0, 0};
  const std::size_t length = frameBytes() * std::size_t(frames_);
  appendWord(head, rle_ ? undefined : length + length % 2);
  if (Status s = write(head); !s || !rle_) return s;
  return write(itemHead(dicomItem, 0));  // an empty table of offsets
}

Status SecondaryCapture::add(std::span<const std::uint8_t> rgb) try {
  if (rgb.size() != frameBytes() || written_ == frames_)
    return Error{"Cannot write " + path_ +
                 ": a frame has another size, or there are more frames than announced."};
  ++written_;
  if (!rle_) return write(rgb);
  const std::vector<std::uint8_t> packed = rleFrame(rgb, size_.x);
  if (Status s = write(itemHead(dicomItem, packed.size())); !s) return s;
  return write(packed);
} catch (const std::bad_alloc&) {
  return Error{"Cannot write " + path_ + ": there is not enough memory to compress a frame."};
}

Status SecondaryCapture::finish() {
  constexpr std::uint32_t sequenceEnd = 0xfffee0dd;
  if (written_ != frames_)
    return Error{"Cannot write " + path_ + ": " + std::to_string(frames_ - written_) +
                 " of its frames are missing."};
  std::vector<std::uint8_t> end;
  if (rle_)
    end = itemHead(sequenceEnd, 0);
  else if (frameBytes() * std::size_t(frames_) % 2)
    end = {0};
  if (Status s = write(end); !s) return s;
  return commitNew(out_, path_);
}

}  // namespace volumen
