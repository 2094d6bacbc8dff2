#include "io/dicom/attributes.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace volumen::dicom {
namespace {

Result<int> wordField(const DataSet& data, std::uint32_t tag, const char* name, std::optional<int> ifAbsent,
                      int low, int high) {
  const auto value = data.word(tag, data.root());
  if (!value && ifAbsent) return *ifAbsent;
  if (!value) return Error{std::string(name) + " " + tagText(tag) + " is missing"};
  if (*value < low || *value > high)
    return Error{std::string(name) + " is " + std::to_string(*value) + ", which no image can have"};
  return int(*value);
}

constexpr std::uint32_t framesTag = 0x00280008, samplesTag = 0x00280002, photometricTag = 0x00280004,
                        storedBitsTag = 0x00280101, highBitTag = 0x00280102, signTag = 0x00280103,
                        paletteTag = 0x00281101;

/// Returns NumberOfFrames: 1 if it is missing, 0 if the file says so.
Result<int> frameCount(const DataSet& data) {
  const std::string text = data.text(framesTag, data.root());
  if (text.empty()) return 1;
  const auto value = parseNumber(text);
  if (!value || *value < 0 || *value > frameLimit || *value != std::floor(*value))
    return Error{"NumberOfFrames is \"" + text + "\", which is no number of frames"};
  return int(*value);
}

/// Returns the number of frames if NumberOfFrames is 0: those that native pixel data hold, or 1 if
/// compressed.
Result<int> framesThere(const Element& pixels, const PixelFormat& format,
                        std::vector<std::string>& warnings) {
  std::uint64_t frames = 1;
  if (pixels.length != undefinedLength) {
    const std::uint64_t each = format.frameBytes(), padding = pixels.length % each;
    frames = pixels.length / each;
    if (frames < 1 || frames > frameLimit || padding > 1)
      return Error{"NumberOfFrames is \"0\", and its pixel data is no whole number of frames"};
  }
  warnings.push_back("its NumberOfFrames is 0: its pixel data is read as " + std::to_string(frames) +
                     (frames == 1 ? " frame" : " frames"));
  return int(frames);
}

/// Reads the photometric interpretation and the layout of colours.
Status readColour(const DataSet& data, PixelFormat& format, std::vector<std::string>& warnings) {
  constexpr std::pair<const char*, int> kinds[] = {
      {"MONOCHROME1", 1}, {"MONOCHROME2", 1},  {"PALETTE COLOR", 1}, {"RGB", 3},
      {"YBR_FULL", 3},    {"YBR_FULL_422", 3}, {"YBR_ICT", 3},       {"YBR_RCT", 3}};
  const auto samples = data.word(samplesTag, data.root());
  format.photometric = data.term(photometricTag, data.root(), "PhotometricInterpretation",
                                 {"MONOCHROME1", "MONOCHROME2", "PALETTE COLOR", "RGB", "YBR_FULL",
                                  "YBR_FULL_422", "YBR_ICT", "YBR_RCT"});
  if (format.photometric.empty() && samples.value_or(1) == 1 && !data.has(paletteTag, data.root())) {
    format.photometric = "MONOCHROME2";
    warnings.emplace_back(
        "its PhotometricInterpretation is missing: one sample a pixel is taken as grey, high values bright");
  }
  if (format.photometric.empty()) return Error{"PhotometricInterpretation (0028,0004) is missing"};
  for (const auto& [name, wanted] : kinds) {
    if (format.photometric != name) continue;
    format.samples = samples.value_or(std::uint16_t(wanted));
    format.planar = format.samples > 1 && data.word(0x00280006, data.root()).value_or(0) == 1;
    if (!samples)
      warnings.push_back("its SamplesPerPixel is missing: " + std::to_string(wanted) +
                         " is taken, as of a picture of " + format.photometric);
    if (format.samples == wanted) return {};
    return Error{"SamplesPerPixel is " + std::to_string(format.samples) + " in " +
                 (format.isGrey() ? "a grey image" : "a colour image (" + format.photometric + ")")};
  }
  return Error{"colour image (" + format.photometric + "): not supported"};
}

/// Reads BitsStored and HighBit and derives each from the other if one is missing.
Status readStoredBits(const DataSet& data, PixelFormat& format, std::vector<std::string>& warnings) {
  const int allocated = format.bitsAllocated;
  const bool knowsStored = data.word(storedBitsTag, data.root()).has_value();
  const auto top = data.word(highBitTag, data.root());
  const int ifAbsent = top && *top < allocated ? *top + 1 : allocated;
  const auto stored = wordField(data, storedBitsTag, "BitsStored", ifAbsent, 1, allocated);
  if (!stored) return stored.error();
  const auto high = wordField(data, highBitTag, "HighBit", *stored - 1, *stored - 1, allocated - 1);
  if (!high) return high.error();
  format.bitsStored = *stored;
  format.highBit = *high;
  const std::string read = "the lower " + std::to_string(*stored) + " of the " + std::to_string(allocated) +
                           " bits of each sample were read";
  if (!knowsStored && allocated > 1) warnings.push_back("its BitsStored is missing: " + read);
  if (!top && *stored < allocated) warnings.push_back("its HighBit is missing: " + read);
  return {};
}

/// Returns whether the bits above the stored ones repeat the highest stored bit, as in signed 16-bit samples.
bool repeatsSign(Bytes begin, const PixelFormat& format) {
  if (format.bitsAllocated != 16 || format.highBit == 15) return false;
  const unsigned all = 0xffffu >> (format.highBit + 1);
  bool anyNegative = false;
  for (std::size_t at = 0; at + 2 <= begin.size(); at += 2) {
    const unsigned sample = numberAt<std::uint16_t>(begin, at, format.bigEndian);
    const bool isNegative = sample >> format.highBit & 1;
    if (sample >> (format.highBit + 1) != (isNegative ? all : 0)) return false;
    anyNegative = anyNegative || isNegative;
  }
  return anyNegative;
}

/// Decides whether samples are signed if PixelRepresentation is missing. It follows, in this order, the VR of
/// other attributes with stored values and the bits above the stored ones. Else 16-bit CT is signed, unless
/// its rescale intercept is so low that unsigned values could be Hounsfield units.
bool isSignedWithoutSaying(const DataSet& data, const Element& pixels, Bytes begin, const PixelFormat& format,
                           std::vector<std::string>& warnings) {
  constexpr std::pair<std::uint32_t, const char*> storedValues[] = {{0x00280120, "PixelPaddingValue"},
                                                                    {0x00280121, "PixelPaddingRangeLimit"},
                                                                    {0x00280106, "SmallestImagePixelValue"},
                                                                    {0x00280107, "LargestImagePixelValue"}};
  const std::string told = "its PixelRepresentation is missing: its values were read as ";
  for (const auto& [tag, name] : storedValues) {
    const Element* e = data.find(tag, data.root());
    const bool isSigned = e && e->vr == vrOf('S', 'S');
    if (!isSigned && !(e && e->vr == vrOf('U', 'S'))) continue;
    warnings.push_back(told + (isSigned ? "signed" : "unsigned") + ", as its " + name + " is");
    return isSigned;
  }
  if (repeatsSign(begin, format)) {
    warnings.push_back(told + "signed, as the bits above them are");
    return true;
  }
  constexpr double lowestOffset = -8192;  // limit: with a lower offset 32768 would still be possible
  // Compressed pixels may have fewer bits if the file does not state BitsStored.
  const bool hasAllBits =
      format.bitsStored == 16 && (pixels.length != undefinedLength || data.has(storedBitsTag, data.root()));
  if (hasAllBits && data.text(0x00080060, data.root()) == "CT" &&
      data.number(0x00281052, data.root()).value_or(0) > lowestOffset) {
    warnings.push_back(told + "signed, for a CT has none from 32768 on");
    return true;
  }
  warnings.push_back(told + "unsigned, which is a guess");
  return false;
}

/// Returns BitsAllocated. If it is missing, it follows from BitsStored or from the length of native pixels.
Result<int> readAllocatedBits(const DataSet& data, const Element& pixels, const PixelFormat& format,
                              std::vector<std::string>& warnings) {
  constexpr std::uint32_t tag = 0x00280100;
  if (data.word(tag, data.root())) return wordField(data, tag, "BitsAllocated", {}, 1, 64);
  const bool isNative = pixels.length != undefinedLength;
  const int stored = data.word(storedBitsTag, data.root()).value_or(0);
  const std::uint64_t samples = format.framePixels() * std::uint64_t(format.frames) *
                                std::uint64_t(format.photometric == "YBR_FULL_422" ? 2 : format.samples);
  std::vector<int> possible;
  for (const int bits : {1, 8, 16, 32}) {
    const std::uint64_t bytes = (samples * std::uint64_t(bits) + 7) / 8;
    const bool fits = pixels.length == bytes || pixels.length == bytes + bytes % 2;
    if (isNative && fits && stored <= bits && (bits > 1 || stored == 1)) possible.push_back(bits);
  }
  if (!isNative && stored > 0 && stored <= 16) possible = {stored <= 8 ? 8 : 16};
  if (possible.size() != 1)
    return Error{"BitsAllocated (0028,0100) is missing, and " +
                 (isNative
                      ? "the " + std::to_string(pixels.length) + " bytes of its pixel data do not tell it"
                      : std::string("its compressed pixels do not tell it"))};
  warnings.push_back("its BitsAllocated is missing: " + std::to_string(possible[0]) + " is taken, as its " +
                     (isNative ? "pixel data is " + std::to_string(pixels.length) + " bytes long"
                               : "BitsStored is " + std::to_string(stored)));
  return possible[0];
}

/// Reads bits, sign and byte order of integer samples.
Status readBits(const DataSet& data, const Element& pixels, Bytes begin, PixelFormat& format,
                std::vector<std::string>& warnings) {
  const auto allocated = readAllocatedBits(data, pixels, format, warnings);
  if (!allocated) return allocated.error();
  format.bitsAllocated = *allocated;
  const int bits = format.bitsAllocated;
  if (bits != 1 && bits != 8 && bits != 16 && bits != 32)
    return Error{"BitsAllocated is " + std::to_string(bits) + "; 1, 8, 16 and 32 are read"};
  if (bits == 1 && format.samples > 1) return Error{"its colours are of one bit a sample"};
  if (Status s = readStoredBits(data, format, warnings); !s) return s;
  const auto sign = wordField(data, signTag, "PixelRepresentation", 0, 0, 1);
  if (!sign) return sign.error();
  const bool isSaid = data.word(signTag, data.root()).has_value();
  const bool matters = bits > 1 && format.samples == 1;
  format.isSigned = isSaid ? *sign == 1 && bits > 1
                           : matters && isSignedWithoutSaying(data, pixels, begin, format, warnings);
  format.bytesInWords = pixels.bigEndian && pixels.vr == vrOf('O', 'W') && bits <= 8;
  return {};
}

/// Returns the view code of a mammogram (PS3.16 CID 4014) as a ViewPosition; empty for other views.
std::string codedView(const DataSet& data) {
  constexpr std::pair<std::string_view, const char*> codes[] = {
      {"399162004", "CC"}, {"R-10242", "CC"}, {"399368009", "MLO"}, {"R-10226", "MLO"},
      {"399260004", "ML"}, {"R-10224", "ML"}, {"399352003", "LM"},  {"R-10228", "LM"}};
  for (const DataSet::Scope& item : data.items(0x00540220, data.root()))
    for (const auto& [code, view] : codes)
      if (data.text(0x00080100, item) == code) return view;
  return {};
}

}  // namespace

void readIdentity(const DataSet& data, FileHeader& header) {
  const DataSet::Scope root = data.root();
  const auto text = [&](std::uint32_t tag) { return data.utf8(tag, root); };
  header.sopClassUid = text(0x00080016);
  header.sopInstanceUid = text(0x00080018);
  header.patientName = text(0x00100010);
  header.patientId = text(0x00100020);
  header.patientIdIssuer = text(0x00100021);
  header.patientBirthDate = dateOrTime(text(0x00100030));
  header.patientSex = text(0x00100040);
  header.patientAge = text(0x00101010);
  header.studyUid = text(0x0020000d);
  header.studyDate = dateOrTime(text(0x00080020));
  header.studyTime = dateOrTime(text(0x00080030));
  header.studyId = text(0x00200010);
  header.accessionNumber = text(0x00080050);
  header.studyDescription = text(0x00081030);
  header.seriesUid = text(0x0020000e);
  header.seriesNumber = text(0x00200011);
  header.modality = text(0x00080060);
  header.description = text(0x0008103e);
  header.bodyPart = text(0x00180015);
  header.laterality = text(0x00200062);
  if (header.laterality.empty()) header.laterality = text(0x00200060);
  header.viewPosition = text(0x00185101);
  if (header.viewPosition.empty()) header.viewPosition = codedView(data);
  header.frameOfReferenceUid = text(0x00200052);
  // Lossy JPEG is lossy whatever the attribute says.
  const std::string& syntax = header.syntax.uid;
  const bool isLossyJpeg =
      syntax.size() == 22 && syntax.starts_with("1.2.840.10008.1.2.4.5") && syntax[21] < '7';
  if (isLossyJpeg || text(0x00282110) == "01") header.lossyRatio = text(0x00282112);
  header.time = dateOrTime(text(0x00080032));
  if (header.time.empty()) header.time = dateOrTime(text(0x00080031));
}

Result<PixelFormat> readPixelFormat(const DataSet& data, const Element& pixels, Bytes begin,
                                    std::vector<std::string>& warnings) {
  PixelFormat format;
  if (Status s = readColour(data, format, warnings); !s) return s.error();
  const auto rows = wordField(data, 0x00280010, "Rows", {}, 1, 65535);
  if (!rows) return rows.error();
  const auto columns = wordField(data, 0x00280011, "Columns", {}, 1, 65535);
  if (!columns) return columns.error();
  const auto frames = frameCount(data);
  if (!frames) return frames.error();
  format.rows = *rows;
  format.columns = *columns;
  format.frames = std::max(1, *frames);
  format.bigEndian = pixels.bigEndian;
  if (pixels.tag == 0x7fe00010) {
    if (Status s = readBits(data, pixels, begin, format, warnings); !s) return s.error();
  } else {
    format.kind = pixels.tag == 0x7fe00008 ? PixelFormat::Kind::float32 : PixelFormat::Kind::float64;
    format.bitsAllocated = format.bitsStored = pixels.tag == 0x7fe00008 ? 32 : 64;
    format.highBit = format.bitsAllocated - 1;
  }
  if (!format.isGrey() &&
      (format.kind != PixelFormat::Kind::integer || (format.samples > 1 && format.isSigned)))
    return Error{"its colours are not unsigned integers"};
  if (*frames > 0) return format;
  const auto there = framesThere(pixels, format, warnings);
  if (!there) return there.error();
  format.frames = *there;
  return format;
}

std::string readContrastAgent(const DataSet& data) {
  std::string agent = data.utf8(0x00180010, data.root());
  for (const DataSet::Scope& item : data.items(0x00180012, data.root()))
    if (agent.empty()) agent = data.utf8(0x00080104, item);
  return agent;
}

Cine readCine(const DataSet& data, int frames) {
  Cine cine;
  const DataSet::Scope root = data.root();
  cine.backAndForth = data.word(0x00181244, root).value_or(0) == 1;
  if (const auto times = data.numbers(0x00181065, root); times && times->size() == std::size_t(frames))
    cine.frameTimesMs = *times;
  const auto positive = [&](std::uint32_t tag) { return std::max(0.0, data.number(tag, root).value_or(0)); };
  // RecommendedDisplayFrameRate, CineRate, FrameTime.
  cine.framesPerSecond = positive(0x00082144);
  if (cine.framesPerSecond == 0) cine.framesPerSecond = positive(0x00180040);
  if (const double ms = positive(0x00181063); cine.framesPerSecond == 0 && ms > 0)
    cine.framesPerSecond = 1000 / ms;
  return cine;
}

}  // namespace volumen::dicom
