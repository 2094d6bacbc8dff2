#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>

#include "io/dicom/attributes.h"
#include "io/dicom/frame_scopes.h"
#include "io/dicom/greys.h"
#include "io/dicom/pixel_size.h"

namespace volumen::dicom {
namespace {

constexpr std::uint32_t planePosition = 0x00209113, planeOrientation = 0x00209116, frameContent = 0x00209111,
                        mrEcho = 0x00189114, mrDiffusion = 0x00189117, mrFrameType = 0x00189226,
                        ctFrameType = 0x00189329, cardiac = 0x00189118;

/// What tells apart pictures of one place, the first that does so deciding: time point, kind of picture,
/// acquisition, diffusion weight, trigger time.
constexpr struct {
  std::uint32_t group, tag;
} partAttributes[] = {
    {0, 0x00200100},
    {frameContent, 0x00209128},
    {0, 0x00080008},
    {mrFrameType, 0x00089007},
    {ctFrameType, 0x00089007},
    {0, 0x00200012},
    {frameContent, 0x00209156},
    {mrDiffusion, 0x00189087},
    {0, 0x00181060},
    {cardiac, 0x00209153},
};

/// The number in an FD, in the fewest digits; empty where there is none.
std::string doubleText(const DataSet& data, std::uint32_t tag, DataSet::Scope scope) {
  const auto value = data.real(tag, scope);
  if (!value) return {};
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, *value).ptr};
}

std::string readEchoTime(const DataSet& data, DataSet::Scope scope) {
  const std::string time = data.text(0x00180081, scope);
  return time.empty() ? doubleText(data, 0x00189082, scope) : time;
}

/// The diffusion weight: DICOM's, or the private one of Siemens or GE, which adds multiples of 100000.
std::string readBValue(const DataSet& data, DataSet::Scope scope) {
  if (const std::string b = doubleText(data, 0x00189087, scope); !b.empty()) return b;
  if (data.text(0x00190010, data.root()) == "SIEMENS MR HEADER") return data.text(0x0019100c, data.root());
  if (data.text(0x00430010, data.root()) != "GEMS_PARM_01") return {};
  const auto numbers = data.numbers(0x00431039, data.root());
  return numbers ? std::to_string(long(std::fmod((*numbers)[0], 100000))) : std::string();
}

/// Number of the time point, where the file counts them.
std::string readTimePoint(const DataSet& data, const FrameScopes& at) {
  const std::string identifier = data.text(0x00200100, at.of(0));
  if (!identifier.empty()) return identifier;
  const auto index = data.dword(0x00209128, at.of(frameContent));
  return index ? std::to_string(*index) : std::string();
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
        "its ImageOrientationPatient is not a pair of unit vectors at right angles and is not used");
    return {};
  }
  if (off > 1e-3) warnings.push_back("its ImageOrientationPatient was made exactly orthonormal");
  Orientation o{glm::normalize(row), {}};
  o.column = glm::normalize(column - glm::dot(column, o.row) * o.row);
  return o;
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

Result<Slice> readSlice(const DataSet& data, const FrameScopes& at, std::vector<std::string>& warnings) {
  Slice slice;
  slice.position = readPosition(data, at.of(planePosition));
  slice.orientation = readOrientation(data, at.of(planeOrientation), warnings);
  slice.spacing = readSpacing(data, 0x00280030, at.of(pixelMeasures));
  slice.thickness = data.number(0x00180050, at.of(pixelMeasures)).value_or(0);
  for (const NamedGrey& grey : readWindows(data, at.of(frameVoiLut)))
    slice.windows.push_back(grey.mapping.window);
  slice.echo = data.text(0x00180086, at.of(mrEcho)) + "/" + data.text(0x00180081, at.of(mrEcho)) + "/" +
               data.raw(0x00189082, at.of(mrEcho));
  slice.echoTime = readEchoTime(data, at.of(mrEcho));
  slice.bValue = readBValue(data, at.of(mrDiffusion));
  slice.timePoint = readTimePoint(data, at);
  for (const auto& [group, tag] : partAttributes) slice.parts.push_back(data.raw(tag, at.of(group)));
  if (Status s = readRescale(data, at.of(pixelValueTransformation), slice); !s) return s.error();
  return slice;
}

void framesWithoutPlace(FileHeader& header) {
  header.notVolume = "several frames without a position each: cannot be shown in 3D";
}

/// The frames of a dose grid: along the normal by GridFrameOffsetVector (PS3.3 C.8.8.3.2).
void placeDoseFrames(const DataSet& data, FileHeader& header) {
  const auto offsets = data.numbers(0x3004000c, data.root());
  const Slice first = header.slices.front();
  // Offsets that do not begin with 0 are positions of some other kind.
  if (!offsets || offsets->size() != std::size_t(header.format.frames) || (*offsets)[0] != 0 ||
      !isPlaced(first))
    return framesWithoutPlace(header);
  const glm::dvec3 normal = glm::cross(first.orientation->row, first.orientation->column);
  header.slices.assign(offsets->size(), first);
  for (std::size_t n = 0; n < offsets->size(); ++n) {
    header.slices[n].frame = int(n);
    header.slices[n].position = *first.position + (*offsets)[n] * normal;
  }
}

/// The frames of an enhanced picture, each with the functional groups that hold for it.
Status readEnhancedFrames(const DataSet& data, FileHeader& header) {
  const auto ofAll = data.items(FrameScopes::sharedGroups, data.root());
  const auto ofFrames = data.items(FrameScopes::perFrameGroups, data.root());
  const std::size_t frames = std::size_t(header.format.frames);
  if (frames > 1 && ofFrames.size() != frames)
    return Error{"it has " + std::to_string(frames) + " frames, but functional groups for " +
                 std::to_string(ofFrames.size())};
  header.slices.clear();
  for (std::size_t n = 0; n < frames; ++n) {
    const FrameScopes at(data, ofFrames.empty() ? DataSet::Scope{} : ofFrames[n],
                         ofAll.empty() ? DataSet::Scope{} : ofAll[0]);
    const auto slice = readSlice(data, at, header.warnings);
    if (!slice) return slice.error();
    if (frames > 1 && !isPlaced(*slice)) framesWithoutPlace(header);
    header.slices.push_back(*slice);
    header.slices.back().frame = int(n);
  }
  return {};
}

/// InstanceNumber, and within a file the number of the frame.
void numberSlices(const DataSet& data, FileHeader& header) {
  constexpr double limit = 1e9;
  const long instance = long(std::clamp(data.number(0x00200013, data.root()).value_or(0), -limit, limit));
  for (Slice& slice : header.slices) slice.instance = instance * (frameLimit + 1) + slice.frame;
}

}  // namespace

Status readSlices(const DataSet& data, FileHeader& header) {
  const auto imageType = data.values(0x00080008, data.root());
  if (std::find(imageType.begin(), imageType.end(), "MOSAIC") != imageType.end())
    header.notVolume = "Siemens mosaic (the slices are tiles of one image): not supported yet";
  if (!header.format.isGrey())
    header.notVolume = "colour image (" + header.format.photometric + "): cannot be shown in 3D";
  if (data.has(0x00283000, data.root()))
    header.warnings.push_back("its Modality LUT Sequence is not applied: values are those before it");
  if (FrameScopes::isEnhanced(data)) {
    if (Status s = readEnhancedFrames(data, header); !s) return s;
  } else {
    const auto slice = readSlice(data, FrameScopes(data.root()), header.warnings);
    if (!slice) return slice.error();
    header.slices = {*slice};
    if (header.format.frames > 1 && header.notVolume.empty()) placeDoseFrames(data, header);
  }
  const auto padding = readPadding(data, header.format);
  for (Slice& slice : header.slices) slice.padding = padding;
  numberSlices(data, header);
  return {};
}

}  // namespace volumen::dicom
