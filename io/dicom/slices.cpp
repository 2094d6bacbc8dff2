#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "io/dicom/attributes.h"
#include "io/dicom/diffusion.h"
#include "io/dicom/frame_scopes.h"
#include "io/dicom/greys.h"
#include "io/dicom/nuclear.h"
#include "io/dicom/pixel_size.h"
#include "io/dicom/separators.h"
#include "io/dicom/slice_place.h"
#include "io/dicom/stack.h"
#include "io/dicom/units.h"

namespace volumen::dicom {
namespace {

constexpr std::uint32_t modalityLut = 0x00283000, spacingBetweenSlices = 0x00180088;

/// Returns the number of the time point, if the file counts them.
std::string readTimePoint(const DataSet& data, const FrameScopes& at) {
  const std::string identifier = data.text(0x00200100, at.of(0));
  if (!identifier.empty()) return identifier;
  const auto index = data.dword(0x00209128, at.of(frameContentGroup));
  return index ? std::to_string(*index) : std::string();
}

Status readRescale(const DataSet& data, DataSet::Scope scope, Slice& slice, FileHeader& header) {
  const auto field = [&](std::uint32_t tag, const char* name, double& value) -> Status {
    if (!data.has(tag, scope)) return {};
    slice.isRescaled = true;
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
  const bool hasSlope = data.has(0x00281053, scope), hasIntercept = data.has(0x00281052, scope);
  if (hasSlope != hasIntercept)
    warnOnce(header, hasSlope ? "its RescaleIntercept is missing: 0 is taken"
                              : "its RescaleSlope is missing: 1 is taken");
  return {};
}

/// Sets the unit if all slices have the same one.
void agreeOnUnit(FileHeader& header) {
  header.unit = header.slices[0].unit;
  const bool agree =
      std::ranges::all_of(header.slices, [&](const Slice& s) { return s.unit == header.unit; });
  if (agree) return;
  header.unit.clear();
  warnOnce(header,
           "the values of its frames have different units, and none is shown beside those of a volume");
}

/// Returns PixelPaddingValue and PixelPaddingRangeLimit in stored values.
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

Result<Slice> readSlice(const DataSet& data, const FrameScopes& at, const Dimensions& dimensions,
                        FileHeader& header) {
  Slice slice;
  readPlace(data, at, slice, header);
  slice.spacing = readSpacing(data, 0x00280030, at.of(pixelMeasures));
  slice.thickness = data.number(0x00180050, at.of(pixelMeasures)).value_or(0);
  slice.echoTime = readEchoTime(data, at);
  slice.bValue = readBValue(data, at);
  slice.timePoint = readTimePoint(data, at);
  slice.inStack = dimensions.inStack(data, at.of(frameContentGroup));
  slice.separators = readSeparators(data, at, dimensions);
  if (Status s = readRescale(data, at.of(pixelValueTransformation), slice, header); !s) return s.error();
  readMeaning(data, at, slice, header);
  if (data.has(modalityLut, data.root())) return slice;  // windows apply after the Modality LUT
  for (const NamedGrey& grey : readWindows(data, at.of(frameVoiLut)))
    slice.windows.push_back(greyOfSlice(grey, slice).mapping.window);
  return slice;
}

/// Returns whether frames without position are ordered slices of a volume: the file calls them a volume and
/// gives their distance.
bool isVolumeInOrder(const DataSet& data, const FrameScopes& at) {
  const double distance = std::max(data.number(spacingBetweenSlices, data.root()).value_or(0),
                                   data.number(spacingBetweenSlices, at.of(pixelMeasures)).value_or(0));
  return data.text(0x00089206, data.root()) == "VOLUME" && distance > 0;
}

/// Stacks frames with position but without pixel size in order of position. Returns false if they are not
/// parallel at distinct positions.
bool stackByPlace(FileHeader& header) {
  constexpr double alike = 1e-3, together = 1e-3;  // tolerances of unit vectors, and of positions in mm
  const std::optional<Orientation> first = header.slices.front().orientation;
  std::vector<std::pair<double, Slice*>> places;
  for (Slice& slice : header.slices) {
    if (!slice.position || !slice.orientation || slice.spacing || slice.ofTransducer) return false;
    if (glm::distance(slice.orientation->row, first->row) > alike ||
        glm::distance(slice.orientation->column, first->column) > alike)
      return false;
    places.emplace_back(glm::dot(*slice.position, glm::cross(first->row, first->column)), &slice);
  }
  std::ranges::sort(places, {}, &std::pair<double, Slice*>::first);
  for (std::size_t n = 0; n < places.size(); ++n) {
    if (n > 0 && places[n].first - places[n - 1].first < together) return false;
    places[n].second->inStack = std::uint32_t(n + 1);
  }
  for (Slice& slice : header.slices) slice.position.reset();
  header.warnings.emplace_back(
      "its PixelSpacing is missing or 0: its frames are stacked in the order of their places");
  return true;
}

/// Handles frames that lack positions: slices of an uncalibrated volume if their order is known, else frames
/// only.
void framesWithoutPlace(const DataSet& data, const FrameScopes& at, FileHeader& header) {
  if (!header.notVolume.empty() || stackByPlace(header)) return;
  const bool ordered = std::ranges::all_of(header.slices, [](const Slice& s) { return s.inStack > 0; });
  if (!ordered && !isVolumeInOrder(data, at)) {
    header.notVolume = "several frames without a position each: cannot be shown in 3D";
    return;
  }
  for (Slice& slice : header.slices) slice.position.reset();
  header.warnings.emplace_back(
      ordered ? "its frames are stacked by their number, for they have no positions of their own"
              : "its frames are stacked in their order, for they have no positions of their own");
}

/// Makes one slice for each frame, all like the first.
void repeatSlice(FileHeader& header) {
  header.slices.assign(std::size_t(header.format.frames), Slice(header.slices.front()));
  for (std::size_t n = 0; n < header.slices.size(); ++n) header.slices[n].frame = int(n);
}

void placeReconstructedNuclear(const DataSet& data, FileHeader& header) {
  repeatSlice(header);
  placeNuclearFrames(data, header);
  if (header.format.frames > 1 && !std::ranges::all_of(header.slices, isPlaced))
    framesWithoutPlace(data, FrameScopes(data.root()), header);
}

/// Returns the offsets of the frames of a dose grid along its normal from the first frame, mm. They are
/// GridFrameOffsetVector itself (a), or follow from z coordinates in it if the grid is axial (b; PS3.3
/// C.8.8.3.2). Returns nothing if it is neither.
std::optional<std::vector<double>> doseOffsets(const DataSet& data, const Slice& first, int frames) {
  constexpr double rounding = 0.01;  // mm for z; a tenth of it for a cosine
  auto offsets = data.numbers(0x3004000c, data.root());
  if (!offsets || offsets->size() != std::size_t(frames) || !isPlaced(first)) return {};
  if (offsets->front() == 0) return offsets;
  const double z = first.position->z,
               normal = glm::cross(first.orientation->row, first.orientation->column).z;
  if (std::abs(offsets->front() - z) > rounding || std::abs(normal) < 1 - rounding / 10) return {};
  for (double& offset : *offsets) offset = (offset - z) / normal;
  return offsets;
}

/// Sets the positions of the frames of a dose grid.
void placeDoseFrames(const DataSet& data, FileHeader& header) {
  const Slice first = header.slices.front();
  const auto offsets = doseOffsets(data, first, header.format.frames);
  if (!offsets) {
    const FrameScopes root(data.root());
    if (isVolumeInOrder(data, root)) repeatSlice(header);
    return framesWithoutPlace(data, root, header);
  }
  const glm::dvec3 normal = glm::cross(first.orientation->row, first.orientation->column);
  repeatSlice(header);
  for (std::size_t n = 0; n < offsets->size(); ++n)
    header.slices[n].position = *first.position + (*offsets)[n] * normal;
}

/// Sets the positions of frames that share one: by their number in the stack, SpacingBetweenSlices apart
/// along the normal.
void placeByNumber(const DataSet& data, const FrameScopes& shared, FileHeader& header) {
  const double distance = data.number(spacingBetweenSlices, shared.of(pixelMeasures)).value_or(0);
  const bool numbered = std::ranges::all_of(header.slices, [](const Slice& s) { return s.inStack > 0; });
  const bool one = std::ranges::all_of(
      header.slices, [&](const Slice& s) { return s.inStack == header.slices.front().inStack; });
  if (!numbered || one) return;  // pictures at one position
  if (!(distance > 0)) return framesWithoutPlace(data, shared, header);
  for (Slice& slice : header.slices) {
    const glm::dvec3 normal = glm::cross(slice.orientation->row, slice.orientation->column);
    *slice.position += (double(slice.inStack) - 1) * distance * normal;
  }
  header.warnings.push_back("its frames share one position: they were placed " + millimetres(distance) +
                            " mm apart by their number in the stack");
}

/// Reads the frames of an enhanced picture, each with the functional groups that apply to it.
Status readEnhancedFrames(const DataSet& data, FileHeader& header) {
  const auto ofAll = data.items(FrameScopes::sharedGroups, data.root());
  const auto ofFrames = data.items(FrameScopes::perFrameGroups, data.root());
  const DataSet::Scope all = ofAll.empty() ? DataSet::Scope{} : ofAll[0];
  const std::size_t frames = std::size_t(header.format.frames);
  if (frames > 1 && !ofFrames.empty() && ofFrames.size() != frames)
    return Error{"it has " + std::to_string(frames) + " frames, but functional groups for " +
                 std::to_string(ofFrames.size())};
  const Dimensions dimensions(data);
  header.slices.clear();
  bool placed = !ofFrames.empty(), ownPlaces = false;
  for (std::size_t n = 0; n < frames; ++n) {
    const DataSet::Scope own = ofFrames.empty() ? DataSet::Scope{} : ofFrames[n];
    const auto slice = readSlice(data, FrameScopes(data, own, all), dimensions, header);
    if (!slice) return slice.error();
    placed = placed && isPlaced(*slice);
    ownPlaces = ownPlaces || data.find(planePosition, own) || data.find(planePositionInVolume, own);
    header.slices.push_back(*slice);
    header.slices.back().frame = int(n);
  }
  const FrameScopes shared(data, {}, all);
  if (frames > 1 && !placed)
    framesWithoutPlace(data, shared, header);
  else if (frames > 1 && !ownPlaces)
    placeByNumber(data, shared, header);
  return {};
}

void readConcatenation(const DataSet& data, Concatenation& whole) {
  const DataSet::Scope root = data.root();
  whole.uid = data.text(0x00209161, root);
  whole.part = data.word(0x00209162, root).value_or(0);
  whole.parts = data.word(0x00209163, root).value_or(0);
  whole.firstFrame = int(std::min<std::uint32_t>(data.dword(0x00209228, root).value_or(0), frameLimit));
}

/// Warns that frames are measured in mm although their volume has no size.
void tellFrameSize(const DataSet& data, FileHeader& header) {
  const FrameScopes at(data, 0);
  const PixelSize size = readPixelSize(data, at, header.modality);
  const bool isClip = !header.notVolume.empty();
  if (isClip || header.modality == "US" || size.kind == PixelSizeKind::unknown || isPlaced(header.slices[0]))
    return;
  char mm[64];
  std::snprintf(mm, sizeof mm, "%.4g x %.4g mm", size.mm.x, size.mm.y);
  const std::string word = pixelSizeWord(size.kind);
  header.warnings.push_back("its frames are measured in mm: a pixel is " + std::string(mm) +
                            (word.empty() ? "" : " " + word));
}

/// Sets the instance from InstanceNumber and the frame's number within the file.
void numberSlices(const DataSet& data, FileHeader& header) {
  constexpr double limit = 1e9;
  const long instance = long(std::clamp(data.number(0x00200013, data.root()).value_or(0), -limit, limit));
  for (Slice& slice : header.slices)
    slice.instance = instance * (2L * frameLimit + 1) + header.concatenation.firstFrame + slice.frame;
}

}  // namespace

Status readSlices(const DataSet& data, FileHeader& header) {
  readConcatenation(data, header.concatenation);
  if (!header.format.isGrey())
    header.notVolume = "colour image (" + header.format.photometric + "): cannot be shown in 3D";
  if (data.has(modalityLut, data.root()))
    header.warnings.push_back(
        "its Modality LUT Sequence is applied to its frames alone: values in 3D are those before it");
  if (FrameScopes::isEnhanced(data)) {
    if (Status s = readEnhancedFrames(data, header); !s) return s;
  } else {
    const auto slice = readSlice(data, FrameScopes(data.root()), Dimensions(data), header);
    if (!slice) return slice.error();
    header.slices = {*slice};
    if (header.notVolume.empty() && isReconstructedNuclear(data))
      placeReconstructedNuclear(data, header);
    else if (header.notVolume.empty() && header.format.frames > 1)
      placeDoseFrames(data, header);
  }
  const auto padding = readPadding(data, header.format);
  for (Slice& slice : header.slices) slice.padding = padding;
  agreeOnUnit(header);
  if (header.pet && header.pet->units.empty() && header.unit == "Bq/ml") header.pet->units = "BQML";
  numberSlices(data, header);
  if (!header.slices.empty()) tellFrameSize(data, header);
  return {};
}

}  // namespace volumen::dicom
