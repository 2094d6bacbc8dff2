#include "io/dicom/dimensions.h"

#include <algorithm>

namespace volumen::dicom {
namespace {

constexpr std::uint32_t inStackPosition = 0x00209057, dimensionValues = 0x00209157;

bool runsAlongPlaces(std::uint32_t pointer) {
  constexpr std::uint32_t places[] = {inStackPosition, 0x00200032, 0x00201041, 0x00209301};
  return std::ranges::find(places, pointer) != std::end(places);
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

}  // namespace volumen::dicom
