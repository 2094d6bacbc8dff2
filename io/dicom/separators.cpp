#include "io/dicom/separators.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "io/dicom/attributes.h"
#include "io/dicom/diffusion.h"

namespace volumen::dicom {
namespace {

constexpr std::uint32_t cardiacGroup = 0x00189118, respiratoryGroup = 0x00209253, mrTimingGroup = 0x00189112,
                        mrModifierGroup = 0x00189115, mrFrameTypeGroup = 0x00189226,
                        ctFrameTypeGroup = 0x00189329, petFrameTypeGroup = 0x00189751,
                        ctReconstructionGroup = 0x00189314, ctXRayGroup = 0x00189325,
                        tomosynthesisFrameTypeGroup = 0x00189504, parametricFrameTypeGroup = 0x00409092,
                        arterialSpinLabelingGroup = 0x00189251, velocityEncodingGroup = 0x00189197,
                        contrastUsageGroup = 0x00189341, petCorrectionGroup = 0x00189736;

/// Holds the attributes that no other group of a converted picture holds (PS3.3 C.7.6.16.2.25.2).
constexpr std::uint32_t unassignedOfFrame = 0x00209171;

enum class SourceKind { text, words, number, real, single, word, dword };

/// The source of a value: an attribute in a functional group, or in the data set itself if `group` is 0.
struct ValueSource {
  std::uint32_t group, tag;
  SourceKind kind;
};

/// Returns several values as the words of one text.
std::string wordsIn(std::string values) {
  std::ranges::replace(values, '\\', ' ');
  return values;
}

std::string valueOf(const DataSet& data, const ValueSource& source, DataSet::Scope scope) {
  switch (source.kind) {
    case SourceKind::text:
      return data.text(source.tag, scope);
    case SourceKind::words:
      return wordsIn(data.utf8(source.tag, scope));
    case SourceKind::number:
      return numberText(data, source.tag, scope);
    case SourceKind::real:
      return realText(data, source.tag, scope);
    case SourceKind::single:
      if (const auto numbers = data.floats(source.tag, scope); !numbers.empty()) return realText(numbers[0]);
      return {};
    case SourceKind::word:
      if (const auto word = data.word(source.tag, scope)) return std::to_string(*word);
      return {};
    case SourceKind::dword:
      if (const auto dword = data.dword(source.tag, scope)) return std::to_string(*dword);
      return {};
  }
  return {};
}

/// Returns the value of the first source that is not empty.
std::string firstOf(const DataSet& data, const FrameScopes& at, std::span<const ValueSource> sources) {
  for (const ValueSource& source : sources) {
    if (source.tag == 0) break;
    if (std::string value = valueOf(data, source, at.of(source.group)); !value.empty()) return value;
    if (source.group != 0 || !at.hasGroup(unassignedOfFrame)) continue;
    if (std::string value = valueOf(data, source, at.of(unassignedOfFrame)); !value.empty()) return value;
  }
  return {};
}

/// Returns the kernel, from CT's reconstruction group if there is one.
std::string readKernel(const DataSet& data, const FrameScopes& at) {
  return wordsIn(data.text(0x00181210, at.of(ctReconstructionGroup)));
}

std::string readVelocityDirection(const DataSet& data, const FrameScopes& at) {
  return data.raw(0x00189090, at.of(velocityEncodingGroup));
}

std::string readAgent(const DataSet& data, const FrameScopes&) { return readContrastAgent(data); }

/// Returns a time of day with its date before it.
std::string withDate(const DataSet& data, std::uint32_t date, std::uint32_t time) {
  const std::string ofDay = data.text(time, data.root()), day = dateOrTime(data.text(date, data.root()));
  return ofDay.empty() || day.size() != 8 ? ofDay : day + dateOrTime(ofDay);
}

std::string readAcquisitionTime(const DataSet& data, const FrameScopes& at) {
  if (std::string time = data.text(0x00189074, at.of(frameContentGroup)); !time.empty()) return time;
  if (std::string time = data.text(0x0008002a, data.root()); !time.empty()) return time;
  return withDate(data, 0x00080022, 0x00080032);
}

std::string readContentTime(const DataSet& data, const FrameScopes&) {
  return withDate(data, 0x00080023, 0x00080033);
}

using Words = Separator::Words;
using Trust = Separator::Trust;
using Along = Separator::Along;

struct SeparatorRow {
  Separator separator;
  std::array<ValueSource, 6> sources;
  std::string (*read)(const DataSet&, const FrameScopes&) = nullptr;  // used in place of `sources`
};

const SeparatorRow separatorRows[] = {
    {{"EchoTime", Trust::always, "TE ", " ms", Words::plain, Along::steady, &Series::echoTime},
     {},
     readEchoTime},
    {{"EchoNumbers", Trust::always, "echo ", ""}, {{{0, 0x00180086, SourceKind::number}}}},
    {{"TemporalPositionIdentifier", Trust::certain, "time point ", "", Words::plain, Along::steady,
      &Series::timePoint},
     {{{0, 0x00200100, SourceKind::number}, {frameContentGroup, 0x00209128, SourceKind::dword}}}},
    {{"NominalPercentageOfCardiacPhase", Trust::certain, "phase ", " %"},
     {{{cardiacGroup, 0x00209241, SourceKind::single}, {0, 0x00209241, SourceKind::number}}}},
    {{"NominalPercentageOfRespiratoryPhase", Trust::certain, "respiratory phase ", " %"},
     {{{respiratoryGroup, 0x00209245, SourceKind::single}, {0, 0x00209245, SourceKind::number}}}},
    {{"DiffusionBValue", Trust::certain, "b ", "", Words::plain, Along::steady, &Series::bValue},
     {},
     readBValue},
    {{"DiffusionDirectionality", Trust::certain, "", ""},
     {{{mrDiffusionGroup, 0x00189075, SourceKind::text}}}},
    {{"ImageType", Trust::certain, "", "", Words::imageType},
     {{{mrFrameTypeGroup, 0x00089007, SourceKind::text},
       {ctFrameTypeGroup, 0x00089007, SourceKind::text},
       {petFrameTypeGroup, 0x00089007, SourceKind::text},
       {tomosynthesisFrameTypeGroup, 0x00089007, SourceKind::text},
       {parametricFrameTypeGroup, 0x00089007, SourceKind::text},
       {0, 0x00080008, SourceKind::text}}}},
    {{"ComplexImageComponent", Trust::certain, "", ""}, {{{mrFrameTypeGroup, 0x00089208, SourceKind::text}}}},
    {{"AcquisitionContrast", Trust::certain, "", ""}, {{{mrFrameTypeGroup, 0x00089209, SourceKind::text}}}},
    {{"VolumeBasedCalculationTechnique", Trust::certain, "calculation ", ""},
     {{{mrFrameTypeGroup, 0x00089207, SourceKind::text},
       {ctFrameTypeGroup, 0x00089207, SourceKind::text},
       {petFrameTypeGroup, 0x00089207, SourceKind::text}}}},
    {{"ASLContext", Trust::certain, "", ""}, {{{arterialSpinLabelingGroup, 0x00189257, SourceKind::text}}}},
    {{"VelocityEncodingDirection", Trust::certain, "velocity direction ", "", Words::direction},
     {},
     readVelocityDirection},
    {{"ConvolutionKernel", Trust::certain, "kernel ", ""}, {}, readKernel},
    {{"KVP", Trust::certain, "", " kV"},
     {{{ctXRayGroup, 0x00180060, SourceKind::number}, {0, 0x00180060, SourceKind::number}}}},
    {{"FlipAngle", Trust::certain, "flip angle ", " degrees"},
     {{{mrTimingGroup, 0x00181314, SourceKind::number}, {0, 0x00181314, SourceKind::number}}}},
    // Vectors of nuclear medicine (PS3.3 C.8.4.8), read frame by frame in io/dicom/nuclear.h.
    {{"EnergyWindowVector", Trust::certain, "energy window ", ""}, {}},
    {{"DetectorVector", Trust::certain, "detector ", ""}, {}},
    {{"RRIntervalVector", Trust::certain, "R-R interval ", ""}, {}},
    {{"TimeSlotVector", Trust::certain, "time slot ", ""}, {}},
    {{"RepetitionTime", Trust::likely, "TR ", " ms", Words::plain, Along::varies},
     {{{mrTimingGroup, 0x00180080, SourceKind::number}, {0, 0x00180080, SourceKind::number}}}},
    {{"InversionTime", Trust::likely, "TI ", " ms", Words::plain, Along::counts},
     {{{mrModifierGroup, 0x00189079, SourceKind::real}, {0, 0x00180082, SourceKind::number}}}},
    {{"SequenceName", Trust::likely, "sequence ", ""}, {{{0, 0x00180024, SourceKind::text}}}},
    {{"AcquisitionNumber", Trust::needed, "acquisition ", "", Words::plain, Along::varies,
      &Series::timePoint},
     {{{frameContentGroup, 0x00209156, SourceKind::word}, {0, 0x00200012, SourceKind::number}}}},
    {{"DiffusionGradientOrientation", Trust::certain, "direction ", "", Words::direction},
     {},
     readGradientDirection},
    {{"FrameReferenceTime", Trust::needed, "", " s", Words::seconds, Along::counts},
     {{{0, 0x00541300, SourceKind::number}}}},
    {{"TriggerTime", Trust::needed, "trigger ", " ms", Words::plain, Along::counts},
     {{{cardiacGroup, 0x00209153, SourceKind::real}, {0, 0x00181060, SourceKind::number}}}},
    {{"AcquisitionTime", Trust::needed, "", "", Words::clock, Along::counts}, {}, readAcquisitionTime},
    {{"ContentTime", Trust::needed, "", "", Words::clock, Along::varies}, {}, readContentTime},
    {{"ActualFrameDuration", Trust::needed, "frame of ", " s", Words::seconds, Along::varies},
     {{{0, 0x00181242, SourceKind::number}}}},
    {{"ContrastBolusAgent", Trust::needed, "contrast ", ""}, {}, readAgent},
    {{"ContrastBolusAgentPhase", Trust::needed, "", ""},
     {{{contrastUsageGroup, 0x00189344, SourceKind::text}}}},
    {{"RescaleSlope", Trust::needed, "rescale slope ", "", Words::plain, Along::varies},
     {{{pixelValueTransformation, 0x00281053, SourceKind::number}}}},
    {{"SliceThickness", Trust::needed, "slice thickness ", " mm", Words::size},
     {{{pixelMeasures, 0x00180050, SourceKind::number}}}},
    {{"ScanOptions", Trust::needed, "scan options ", ""}, {{{0, 0x00180022, SourceKind::words}}}},
    {{"CorrectedImage", Trust::needed, "corrected ", ""}, {{{0, 0x00280051, SourceKind::words}}}},
    {{"AttenuationCorrected", Trust::needed, "attenuation corrected ", ""},
     {{{petCorrectionGroup, 0x00189759, SourceKind::text}}}},
    {{"ReconstructionMethod", Trust::needed, "reconstruction ", ""},
     {{{0, 0x00541103, SourceKind::words}, {ctReconstructionGroup, 0x00189315, SourceKind::text}}}},
    {{"StackID", Trust::needed, "stack ", ""}, {{{frameContentGroup, 0x00209056, SourceKind::words}}}},
    {{"FrameLabel", Trust::needed, "", ""}, {{{frameContentGroup, 0x00209453, SourceKind::words}}}},
    {{"SeriesNumber", Trust::needed, "series ", ""}, {{{0, 0x00200011, SourceKind::number}}}},
    {{"ProtocolName", Trust::needed, "protocol ", ""}, {{{0, 0x00181030, SourceKind::words}}}},
    {{"SeriesDescription", Trust::needed, "description ", ""}, {{{0, 0x0008103e, SourceKind::words}}}},
};

/// The indices of the dimensions that no attribute of the table explains.
constexpr Separator dimensionIndices{"DimensionIndexValues", Trust::needed, "dimension ", "",
                                     Words::plain,           Along::varies};

constexpr std::size_t separatorCount = std::size(separatorRows) + 1;

std::array<Separator, separatorCount> allSeparators() {
  std::array<Separator, separatorCount> all{};
  std::ranges::transform(separatorRows, all.begin(), &SeparatorRow::separator);
  all.back() = dimensionIndices;
  return all;
}

}  // namespace

std::span<const Separator> separators() {
  static const std::array<Separator, separatorCount> all = allSeparators();
  return all;
}

std::vector<std::string> readSeparators(const DataSet& data, const FrameScopes& at,
                                        const Dimensions& dimensions) {
  std::vector<std::string> values;
  values.reserve(separatorCount);
  for (const SeparatorRow& row : separatorRows)
    values.push_back(row.read ? row.read(data, at) : firstOf(data, at, row.sources));
  values.push_back(dimensions.others(data, at.of(frameContentGroup)));
  return values;
}

std::size_t separatorAt(std::string_view keyword) {
  const auto all = separators();
  return std::size_t(std::ranges::find(all, keyword, &Separator::keyword) - all.begin());
}

void setSeparator(Slice& slice, std::string_view keyword, const std::string& value) {
  slice.separators.at(separatorAt(keyword)) = value;
}

std::string readEchoTime(const DataSet& data, const FrameScopes& at) {
  const DataSet::Scope scope = at.of(mrEchoGroup);
  const std::string time = numberText(data, 0x00180081, scope);
  return time.empty() ? realText(data, 0x00189082, scope) : time;
}

std::string numberText(const DataSet& data, std::uint32_t tag, DataSet::Scope scope) {
  const auto number = data.number(tag, scope);  // "22.0000" is "22"
  return number ? realText(*number) : data.text(tag, scope);
}

std::string realText(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string realText(const DataSet& data, std::uint32_t tag, DataSet::Scope scope) {
  const auto value = data.real(tag, scope);
  return value ? realText(*value) : std::string();
}

}  // namespace volumen::dicom
