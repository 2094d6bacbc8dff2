#include "io/dicom/parts.h"

#include <algorithm>
#include <charconv>

namespace volumen::dicom {
namespace {

constexpr std::uint32_t mrFrameType = 0x00189226, ctFrameType = 0x00189329, cardiac = 0x00189118,
                        inStackPosition = 0x00209057, dimensionValues = 0x00209157;

enum class Value { text, word, dword, real };
enum class Name { known, kind, timePoint, trigger };

/// The first that tells pictures apart decides. `known`: Series has it anyway.
constexpr struct {
  std::uint32_t group, tag;
  Value value;
  Name name;
} attributes[] = {
    {0, 0x00200100, Value::text, Name::known},
    {frameContentGroup, 0x00209128, Value::dword, Name::known},
    {0, 0x00080008, Value::text, Name::kind},
    {mrFrameType, 0x00089007, Value::text, Name::kind},
    {ctFrameType, 0x00089007, Value::text, Name::kind},
    {0, 0x00200012, Value::text, Name::timePoint},
    {frameContentGroup, 0x00209156, Value::word, Name::timePoint},
    {mrDiffusionGroup, 0x00189087, Value::real, Name::known},
    {0, 0x00181060, Value::text, Name::trigger},
    {cardiac, 0x00209153, Value::real, Name::trigger},
};
constexpr std::size_t directionPart = std::size(attributes), dimensionPart = directionPart + 1;

std::string valueText(const DataSet& data, std::uint32_t tag, DataSet::Scope scope, Value value) {
  if (value == Value::text) return data.text(tag, scope);
  if (value == Value::real) return realText(data, tag, scope);
  if (value == Value::word) {
    const auto word = data.word(tag, scope);
    return word ? std::to_string(*word) : std::string();
  }
  const auto dword = data.dword(tag, scope);
  return dword ? std::to_string(*dword) : std::string();
}

/// The diffusion gradient's direction as it stands in the file: only compared.
std::string readDirection(const DataSet& data, DataSet::Scope diffusion) {
  const auto items = data.items(0x00189076, diffusion);
  return items.empty() ? std::string() : data.raw(0x00189089, items[0]);
}

bool runsAlongPlaces(std::uint32_t pointer) {
  constexpr std::uint32_t places[] = {inStackPosition, 0x00200032, 0x00201041, 0x00209301};
  return std::ranges::find(places, pointer) != std::end(places);
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
    if (!alike) label += (label.empty() ? "" : " ") + own[c];
  }
  return label;
}

}  // namespace

Dimensions::Dimensions(const DataSet& data) {
  for (const DataSet::Scope& item : data.items(0x00209222, data.root())) {
    const std::vector<std::uint16_t> tag = data.words(0x00209165, item);
    pointers.push_back(tag.size() < 2 ? 0 : std::uint32_t(tag[0]) << 16 | tag[1]);
  }
}

std::uint32_t Dimensions::inStack(const DataSet& data, DataSet::Scope frameContent) const {
  if (const auto number = data.dword(inStackPosition, frameContent)) return *number;
  const std::vector<std::uint32_t> values = data.dwords(dimensionValues, frameContent);
  for (std::size_t n = 0; n < std::min(values.size(), pointers.size()); ++n)
    if (runsAlongPlaces(pointers[n])) return values[n];
  return 0;
}

std::string Dimensions::others(const DataSet& data, DataSet::Scope frameContent) const {
  const std::vector<std::uint32_t> values = data.dwords(dimensionValues, frameContent);
  std::string text;
  for (std::size_t n = 0; n < std::min(values.size(), pointers.size()); ++n)
    if (!runsAlongPlaces(pointers[n])) text += (text.empty() ? "" : ", ") + std::to_string(values[n]);
  return text;
}

const std::size_t partCount = dimensionPart + 1;

std::vector<std::string> readParts(const DataSet& data, const FrameScopes& at, const Dimensions& dimensions) {
  std::vector<std::string> parts;
  for (const auto& a : attributes) parts.push_back(valueText(data, a.tag, at.of(a.group), a.value));
  parts.push_back(readDirection(data, at.of(mrDiffusionGroup)));
  parts.push_back(dimensions.others(data, at.of(frameContentGroup)));
  return parts;
}

PartName partName(std::size_t part, const std::vector<std::string>& values, std::size_t n) {
  const std::string& value = values[n];
  if (part == directionPart) return {{}, "direction " + std::to_string(n + 1)};
  if (part == dimensionPart) return {{}, "dimension " + value};
  switch (attributes[part].name) {
    case Name::kind:
      return {{}, differing(values, n)};
    case Name::timePoint:
      return {value, {}};
    case Name::trigger:
      return {{}, "trigger " + value + " ms"};
    case Name::known:
      break;
  }
  return {};
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
