#include "io/dicom/attributes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumen::dicom {
namespace {

constexpr int frameLimit = 1'000'000;

Result<int> wordField(const DataSet& data, std::uint32_t tag, const char* name, std::optional<int> ifAbsent,
                      int low, int high) {
  const auto value = data.word(tag, data.root());
  if (!value && ifAbsent) return *ifAbsent;
  if (!value) return Error{std::string(name) + " " + tagText(tag) + " is missing"};
  if (*value < low || *value > high)
    return Error{std::string(name) + " is " + std::to_string(*value) + ", which no picture can have"};
  return int(*value);
}

Result<int> frameCount(const DataSet& data) {
  const std::string text = data.text(0x00280008, data.root());
  if (text.empty()) return 1;
  const auto value = parseNumber(text);
  if (!value || *value < 1 || *value > frameLimit || *value != std::floor(*value))
    return Error{"NumberOfFrames is \"" + text + "\", which is no number of frames"};
  return int(*value);
}

Status checkColour(const DataSet& data) {
  const std::string photometric = data.text(0x00280004, data.root());
  const int samples = data.word(0x00280002, data.root()).value_or(1);
  if (photometric == "MONOCHROME1" || photometric == "MONOCHROME2") {
    if (samples == 1) return {};
    return Error{"SamplesPerPixel is " + std::to_string(samples) + " in a grey picture"};
  }
  if (photometric.empty()) return Error{"PhotometricInterpretation (0028,0004) is missing"};
  return Error{"it is a colour picture (" + photometric + "), which is no volume"};
}

/// Bits, sign and order of integer samples.
Status readBits(const DataSet& data, const Element& pixels, PixelFormat& format) {
  const auto allocated = wordField(data, 0x00280100, "BitsAllocated", {}, 1, 64);
  if (!allocated) return allocated.error();
  format.bitsAllocated = *allocated;
  if (format.bitsAllocated == 1) return Error{"pictures of one bit a pixel (segmentations) are not read"};
  if (format.bitsAllocated != 8 && format.bitsAllocated != 16 && format.bitsAllocated != 32)
    return Error{"BitsAllocated is " + std::to_string(format.bitsAllocated) + "; 8, 16 and 32 are read"};
  const auto stored =
      wordField(data, 0x00280101, "BitsStored", format.bitsAllocated, 1, format.bitsAllocated);
  if (!stored) return stored.error();
  const auto high =
      wordField(data, 0x00280102, "HighBit", *stored - 1, *stored - 1, format.bitsAllocated - 1);
  if (!high) return high.error();
  const auto sign = wordField(data, 0x00280103, "PixelRepresentation", 0, 0, 1);
  if (!sign) return sign.error();
  format.bitsStored = *stored;
  format.highBit = *high;
  format.isSigned = *sign == 1;
  format.bytesInWords = pixels.bigEndian && pixels.vr == vrOf('O', 'W') && format.bitsAllocated == 8;
  return {};
}

std::optional<glm::dvec3> vectorAt(const std::vector<double>& v, std::size_t at) {
  if (v.size() < at + 3) return {};
  return glm::dvec3(v[at], v[at + 1], v[at + 2]);
}

std::optional<glm::dvec3> readPosition(const DataSet& data, DataSet::Scope scope) {
  const auto v = data.numbers(0x00200032, scope);
  return v ? vectorAt(*v, 0) : std::nullopt;
}

/// Unit vectors at right angles; nothing where the file's are neither (by more than 1 %).
std::optional<Orientation> readOrientation(const DataSet& data, DataSet::Scope scope,
                                           std::vector<std::string>& warnings) {
  const auto v = data.numbers(0x00200037, scope);
  if (!v || v->size() < 6) return {};
  const glm::dvec3 row = *vectorAt(*v, 0), column = *vectorAt(*v, 3);
  const double off = std::max(
      {std::abs(glm::length(row) - 1), std::abs(glm::length(column) - 1), std::abs(glm::dot(row, column))});
  if (!(off <= 0.01)) {
    warnings.push_back(
        "its ImageOrientationPatient is no pair of unit vectors at right angles and is not used");
    return {};
  }
  if (off > 1e-3) warnings.push_back("its ImageOrientationPatient was made exactly orthonormal");
  Orientation o{glm::normalize(row), {}};
  o.column = glm::normalize(column - glm::dot(column, o.row) * o.row);
  return o;
}

std::optional<glm::dvec2> readSpacing(const DataSet& data, DataSet::Scope scope) {
  const auto v = data.numbers(0x00280030, scope);
  if (!v || v->size() < 2 || !((*v)[0] > 0) || !((*v)[1] > 0)) return {};
  return glm::dvec2((*v)[1], (*v)[0]);  // PS3.3 10.7.1.3: first between rows, then between columns
}

Status readRescale(const DataSet& data, DataSet::Scope scope, Slice& slice) {
  const auto field = [&](std::uint32_t tag, const char* name, double& value) -> Status {
    if (!data.has(tag, scope)) return {};
    const auto number = data.number(tag, scope);
    if (!number) return Error{std::string(name) + " \"" + data.text(tag, scope) + "\" is no number"};
    value = *number;
    return {};
  };
  if (Status s = field(0x00281053, "RescaleSlope", slice.slope); !s) return s;
  if (Status s = field(0x00281052, "RescaleIntercept", slice.intercept); !s) return s;
  // Doses are scaled by an attribute of their own (PS3.3 C.8.8.3).
  if (Status s = field(0x3004000e, "DoseGridScaling", slice.slope); !s) return s;
  if (slice.slope == 0) return Error{"RescaleSlope is 0"};
  return {};
}

/// PixelPaddingValue and PixelPaddingRangeLimit, in stored values.
std::optional<ValueRange> readPadding(const DataSet& data, const PixelFormat& format) {
  const auto stored = [&](std::uint16_t word) {
    return format.isSigned ? double(std::int16_t(word)) : double(word);
  };
  const auto value = data.word(0x00280120, data.root());
  if (!value || format.kind != PixelFormat::Kind::integer) return {};
  const double first = stored(*value);
  const double second = stored(data.word(0x00280121, data.root()).value_or(*value));
  return ValueRange{std::min(first, second), std::max(first, second)};
}

std::vector<Window> readWindows(const DataSet& data, DataSet::Scope scope) {
  std::vector<Window> windows;
  const auto centres = data.numbers(0x00281050, scope), widths = data.numbers(0x00281051, scope);
  if (!centres || !widths) return windows;
  for (std::size_t n = 0; n < std::min(centres->size(), widths->size()); ++n)
    if ((*widths)[n] > 0) windows.push_back({(*centres)[n], (*widths)[n]});
  return windows;
}

Slice readSlice(const DataSet& data, std::vector<std::string>& warnings) {
  const DataSet::Scope root = data.root();
  Slice slice;
  slice.position = readPosition(data, root);
  slice.orientation = readOrientation(data, root, warnings);
  slice.spacing = readSpacing(data, root);
  slice.thickness = data.number(0x00180050, root).value_or(0);
  slice.windows = readWindows(data, root);
  slice.instance = long(std::clamp(data.number(0x00200013, root).value_or(0), -1e9, 1e9));
  slice.echo = data.text(0x00180086, root) + "/" + data.text(0x00180081, root);
  for (std::uint32_t tag : {0x00200100u, 0x00080008u, 0x00200012u, 0x00189087u, 0x00181060u})
    slice.parts.push_back(data.text(tag, root));
  return slice;
}

/// The frames of a dose grid: along the normal by GridFrameOffsetVector (PS3.3 C.8.8.3.2).
Status placeDoseFrames(const DataSet& data, FileHeader& header) {
  const auto offsets = data.numbers(0x3004000c, data.root());
  const Slice first = header.slices.front();
  if (!offsets || offsets->size() != std::size_t(header.format.frames) || (*offsets)[0] != 0 ||
      !first.position || !first.orientation)
    return Error{"it has several frames, and where each of them lies is not said"};
  const glm::dvec3 normal = glm::cross(first.orientation->row, first.orientation->column);
  header.slices.assign(offsets->size(), first);
  for (std::size_t n = 0; n < offsets->size(); ++n) {
    header.slices[n].frame = int(n);
    header.slices[n].position = *first.position + (*offsets)[n] * normal;
  }
  return {};
}

}  // namespace

void readIdentity(const DataSet& data, FileHeader& header) {
  const DataSet::Scope root = data.root();
  const std::string characters = data.text(0x00080005, root);
  const auto text = [&](std::uint32_t tag) { return toUtf8(data.text(tag, root), characters); };
  header.sopClassUid = text(0x00080016);
  header.sopInstanceUid = text(0x00080018);
  header.patientName = text(0x00100010);
  header.patientId = text(0x00100020);
  header.studyUid = text(0x0020000d);
  header.studyDate = text(0x00080020);
  header.studyDescription = text(0x00081030);
  header.seriesUid = text(0x0020000e);
  header.seriesNumber = text(0x00200011);
  header.modality = text(0x00080060);
  header.description = text(0x0008103e);
}

Result<PixelFormat> readPixelFormat(const DataSet& data, const Element& pixels) {
  PixelFormat format;
  if (Status s = checkColour(data); !s) return s.error();
  const auto rows = wordField(data, 0x00280010, "Rows", {}, 1, 65535);
  if (!rows) return rows.error();
  const auto columns = wordField(data, 0x00280011, "Columns", {}, 1, 65535);
  if (!columns) return columns.error();
  const auto frames = frameCount(data);
  if (!frames) return frames.error();
  format.rows = *rows;
  format.columns = *columns;
  format.frames = *frames;
  format.bigEndian = pixels.bigEndian;
  if (pixels.tag == 0x7fe00010) {
    if (Status s = readBits(data, pixels, format); !s) return s.error();
  } else {
    format.kind = pixels.tag == 0x7fe00008 ? PixelFormat::Kind::float32 : PixelFormat::Kind::float64;
    format.bitsAllocated = format.bitsStored = pixels.tag == 0x7fe00008 ? 32 : 64;
    format.highBit = format.bitsAllocated - 1;
  }
  return format;
}

Status readSlices(const DataSet& data, FileHeader& header) {
  Slice slice = readSlice(data, header.warnings);
  if (Status s = readRescale(data, data.root(), slice); !s) return s;
  slice.padding = readPadding(data, header.format);
  if (data.has(0x00283000, data.root()))
    header.warnings.push_back("its Modality LUT Sequence is not applied: values are those before it");
  const auto imageType = data.values(0x00080008, data.root());
  if (std::find(imageType.begin(), imageType.end(), "MOSAIC") != imageType.end())
    return Error{"it is a Siemens mosaic (many slices as tiles of one picture), which is not read yet"};
  if (!data.items(0x52009229, data.root()).empty() || !data.items(0x52009230, data.root()).empty())
    return Error{"enhanced multi-frame pictures are not read yet"};
  header.slices = {slice};
  if (header.format.frames == 1) return {};
  return placeDoseFrames(data, header);
}

}  // namespace volumen::dicom
