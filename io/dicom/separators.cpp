#include "io/dicom/separators.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

namespace volumen::dicom {
namespace {

constexpr std::uint32_t cardiacGroup = 0x00189118, respiratoryGroup = 0x00209253, mrTimingGroup = 0x00189112,
                        mrModifierGroup = 0x00189115, mrFrameTypeGroup = 0x00189226,
                        ctFrameTypeGroup = 0x00189329, petFrameTypeGroup = 0x00189751,
                        ctReconstructionGroup = 0x00189314, ctXRayGroup = 0x00189325,
                        ctExposureGroup = 0x00189321;

enum class SourceKind { text, number, real, single, word, dword };

/// Where a value may stand: an attribute in a functional group, 0: in the data set itself.
struct ValueSource {
  std::uint32_t group, tag;
  SourceKind kind;
};

std::string numberText(const DataSet& data, std::uint32_t tag, DataSet::Scope scope) {
  const auto number = data.number(tag, scope);  // "22.0000" is "22"
  return number ? realText(*number) : data.text(tag, scope);
}

std::string valueOf(const DataSet& data, const ValueSource& source, DataSet::Scope scope) {
  switch (source.kind) {
    case SourceKind::text:
      return data.text(source.tag, scope);
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

/// The first source that says something.
std::string firstOf(const DataSet& data, const FrameScopes& at, std::span<const ValueSource> sources) {
  for (const ValueSource& source : sources)
    if (source.tag == 0)
      break;
    else if (std::string value = valueOf(data, source, at.of(source.group)); !value.empty())
      return value;
  return {};
}

std::string privateBValue(const DataSet& data) {
  if (const auto tag = data.privateTag(0x0019, "SIEMENS MR HEADER", 0x0c, data.root()))
    if (std::string b = numberText(data, tag, data.root()); !b.empty()) return b;
  if (const auto tag = data.privateTag(0x2001, "Philips Imaging DD 001", 0x03, data.root())) {
    const std::string bytes = data.raw(tag, data.root());
    float b = 0;
    if (bytes.size() == sizeof b) {
      std::memcpy(&b, bytes.data(), sizeof b);
      if (std::isfinite(b)) return realText(b);
    }
  }
  if (const auto tag = data.privateTag(0x0043, "GEMS_PARM_01", 0x39, data.root()))
    if (const auto numbers = data.numbers(tag, data.root()))
      return realText(std::trunc(std::fmod((*numbers)[0], 100000)));
  return {};
}

/// The diffusion gradient's direction as it stands in the file: only compared.
std::string readDirection(const DataSet& data, const FrameScopes& at) {
  const DataSet::Scope diffusion = at.of(mrDiffusionGroup);
  if (const auto items = data.items(0x00189076, diffusion); !items.empty())
    return data.raw(0x00189089, items[0]);
  std::string direction = data.raw(0x00189089, data.root());
  if (!direction.empty()) return direction;
  for (const double x : privateDirection(data)) direction += (direction.empty() ? "" : "\\") + realText(x);
  return direction;
}

/// The fields of CT's reconstruction group are items of a sequence in it.
std::string readKernel(const DataSet& data, const FrameScopes& at) {
  std::string kernel = data.text(0x00181210, at.of(ctReconstructionGroup));
  std::ranges::replace(kernel, '\\', ' ');
  return kernel;
}

/// A date in front of a time of day.
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

/// The date in front of a time, "20260314"; empty: there is none.
std::string dayOf(const std::string& time) {
  return time.size() >= 14 && time.find('.') != 6 ? time.substr(0, 8) : std::string();
}

/// The time of day; of several days with the date.
std::string clockText(const std::vector<std::string>& times, std::size_t n) {
  const std::string day = dayOf(times[n]), of = times[n].substr(day.size());
  if (of.size() < 6) return times[n];
  const std::string clock = of.substr(0, 2) + ":" + of.substr(2, 2) + ":" + of.substr(4);
  const bool oneDay =
      std::ranges::all_of(times, [&](const std::string& other) { return dayOf(other) == day; });
  if (oneDay || day.empty()) return clock;
  return day.substr(0, 4) + "-" + day.substr(4, 2) + "-" + day.substr(6) + " " + clock;
}

using Words = Separator::Words;
using Trust = Separator::Trust;

struct SeparatorRow {
  Separator separator;
  std::array<ValueSource, 4> sources;
  std::string (*read)(const DataSet&, const FrameScopes&) = nullptr;  // in place of sources
};

const SeparatorRow separatorRows[] = {
    {{"EchoTime", Trust::always, "TE ", " ms", Words::plain, false, &Series::echoTime}, {}, readEchoTime},
    {{"EchoNumbers", Trust::always, "echo ", ""}, {{{0, 0x00180086, SourceKind::number}}}},
    {{"TemporalPositionIdentifier", Trust::certain, "time point ", "", Words::plain, false,
      &Series::timePoint},
     {{{0, 0x00200100, SourceKind::number}, {frameContentGroup, 0x00209128, SourceKind::dword}}}},
    {{"NominalPercentageOfCardiacPhase", Trust::certain, "phase ", " %"},
     {{{cardiacGroup, 0x00209241, SourceKind::single}, {0, 0x00209241, SourceKind::number}}}},
    {{"NominalPercentageOfRespiratoryPhase", Trust::certain, "respiratory phase ", " %"},
     {{{respiratoryGroup, 0x00209245, SourceKind::single}, {0, 0x00209245, SourceKind::number}}}},
    {{"DiffusionBValue", Trust::certain, "b ", "", Words::plain, false, &Series::bValue}, {}, readBValue},
    {{"ImageType", Trust::certain, "", "", Words::imageType},
     {{{mrFrameTypeGroup, 0x00089007, SourceKind::text},
       {ctFrameTypeGroup, 0x00089007, SourceKind::text},
       {petFrameTypeGroup, 0x00089007, SourceKind::text},
       {0, 0x00080008, SourceKind::text}}}},
    {{"ConvolutionKernel", Trust::certain, "kernel ", ""}, {}, readKernel},
    {{"KVP", Trust::certain, "", " kV"},
     {{{ctXRayGroup, 0x00180060, SourceKind::number}, {0, 0x00180060, SourceKind::number}}}},
    {{"FlipAngle", Trust::certain, "flip angle ", " degrees"},
     {{{mrTimingGroup, 0x00181314, SourceKind::number}, {0, 0x00181314, SourceKind::number}}}},
    // Of nuclear medicine (PS3.3 C.8.4.8), frame by frame: io/dicom/nuclear.h.
    {{"TimeSlotVector", Trust::certain, "time slot ", ""}, {}},
    {{"RRIntervalVector", Trust::certain, "R-R interval ", ""}, {}},
    {{"EnergyWindowVector", Trust::certain, "energy window ", ""}, {}},
    {{"DetectorVector", Trust::certain, "detector ", ""}, {}},
    {{"SequenceName", Trust::likely, "sequence ", ""}, {{{0, 0x00180024, SourceKind::text}}}},
    {{"InversionTime", Trust::likely, "TI ", " ms", Words::plain, true},
     {{{mrModifierGroup, 0x00189079, SourceKind::real}, {0, 0x00180082, SourceKind::number}}}},
    {{"RepetitionTime", Trust::likely, "TR ", " ms"},
     {{{mrTimingGroup, 0x00180080, SourceKind::number}, {0, 0x00180080, SourceKind::number}}}},
    {{"AcquisitionNumber", Trust::needed, "acquisition ", "", Words::plain, false, &Series::timePoint},
     {{{frameContentGroup, 0x00209156, SourceKind::word}, {0, 0x00200012, SourceKind::number}}}},
    {{"DiffusionGradientOrientation", Trust::certain, "direction ", "", Words::direction}, {}, readDirection},
    {{"TriggerTime", Trust::needed, "trigger ", " ms", Words::plain, true},
     {{{cardiacGroup, 0x00209153, SourceKind::real}, {0, 0x00181060, SourceKind::number}}}},
    {{"FrameReferenceTime", Trust::needed, "", " s", Words::seconds, true},
     {{{0, 0x00541300, SourceKind::number}}}},
    {{"ActualFrameDuration", Trust::needed, "frame of ", " s", Words::seconds},
     {{{0, 0x00181242, SourceKind::number}}}},
    {{"AcquisitionTime", Trust::needed, "", "", Words::clock, true}, {}, readAcquisitionTime},
    {{"ContentTime", Trust::needed, "", "", Words::clock}, {}, readContentTime},
    {{"ContrastBolusAgent", Trust::needed, "", ""}, {{{0, 0x00180010, SourceKind::text}}}},
    {{"RescaleSlope", Trust::needed, "rescale slope ", ""},
     {{{pixelValueTransformation, 0x00281053, SourceKind::number}}}},
};

/// The indices of the dimensions that no attribute of the table explains.
constexpr Separator dimensionIndices{"DimensionIndexValues", Trust::needed, "dimension ", ""};

constexpr std::size_t separatorCount = std::size(separatorRows) + 1;

std::array<Separator, separatorCount> table() {
  std::array<Separator, separatorCount> all{};
  std::ranges::transform(separatorRows, all.begin(), &SeparatorRow::separator);
  all.back() = dimensionIndices;
  return all;
}

std::vector<std::string> components(const std::string& text) {
  std::vector<std::string> all(1);
  for (const char c : text)
    if (c == '\\')
      all.emplace_back();
    else
      all.back() += c;
  return all;
}

/// What of "ORIGINAL\PRIMARY\M" not all of these have.
std::string differing(const std::vector<std::string>& values, std::size_t n) {
  std::string label;
  const std::vector<std::string> own = components(values[n]);
  for (std::size_t c = 0; c < own.size(); ++c) {
    const bool alike = std::ranges::all_of(values, [&](const std::string& value) {
      const std::vector<std::string> other = components(value);
      return c < other.size() && other[c] == own[c];
    });
    if (!alike && !own[c].empty()) label += (label.empty() ? "" : " ") + own[c];
  }
  return label;
}

std::string secondsText(const std::string& milliseconds) {
  const auto ms = parseNumber(milliseconds);
  return ms ? realText(*ms / 1000) : milliseconds;
}

}  // namespace

std::span<const Separator> separators() {
  static const std::array<Separator, separatorCount> all = table();
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

void setSeparator(Slice& slice, std::string_view keyword, const std::string& value) {
  const auto all = separators();
  const auto at = std::ranges::find_if(all, [&](const Separator& s) { return s.keyword == keyword; });
  slice.separators.at(std::size_t(at - all.begin())) = value;
}

std::string wordsOf(const Separator& separator, const std::vector<std::string>& values, std::size_t n) {
  const std::string before = separator.before, &value = values[n];
  if (separator.words == Words::direction) return before + std::to_string(n + 1);
  if (value.empty()) return before + "not given";
  switch (separator.words) {
    case Words::imageType:
      return differing(values, n);
    case Words::clock:
      return clockText(values, n);
    case Words::seconds:
      return before + secondsText(value) + separator.after;
    default:
      return before + value + separator.after;
  }
}

std::vector<double> privateDirection(const DataSet& data) {
  const DataSet::Scope root = data.root();
  if (const auto tag = data.privateTag(0x0019, "SIEMENS MR HEADER", 0x0e, root))
    if (const auto direction = data.reals(tag, root); direction.size() == 3) return direction;
  const auto right = data.privateTag(0x2005, "Philips MR Imaging DD 001", 0xb0, root);
  std::vector<double> direction;
  for (std::uint32_t axis = 0; right && axis < 3; ++axis)
    if (const auto along = data.floats(right + axis, root); along.size() == 1) direction.push_back(along[0]);
  return direction.size() == 3 ? direction : std::vector<double>();
}

std::string readBValue(const DataSet& data, const FrameScopes& at) {
  if (std::string b = realText(data, 0x00189087, at.of(mrDiffusionGroup)); !b.empty()) return b;
  return privateBValue(data);
}

std::string readEchoTime(const DataSet& data, const FrameScopes& at) {
  const DataSet::Scope scope = at.of(mrEchoGroup);
  const std::string time = numberText(data, 0x00180081, scope);
  return time.empty() ? realText(data, 0x00189082, scope) : time;
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
