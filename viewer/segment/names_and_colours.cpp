#include "viewer/segment/names_and_colours.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <set>

#include "viewer/volume/free_name.h"

namespace volumen {

namespace {

constexpr glm::u8vec3 tenColours[] = {{230, 25, 75},   {60, 180, 75},  {255, 225, 25}, {67, 99, 216},
                                      {245, 130, 49},  {70, 240, 240}, {240, 50, 230}, {188, 246, 12},
                                      {250, 190, 190}, {0, 128, 128}};

}  // namespace

glm::u8vec3 tenColour(int number) {
  return tenColours[std::size_t(std::abs(std::int64_t(number))) % std::size(tenColours)];
}

glm::u8vec3 freeTenColour(int first, const std::function<bool(glm::u8vec3)>& isTaken) {
  for (int n = first; n < first + int(std::size(tenColours)); ++n)
    if (!isTaken(tenColour(n))) return tenColour(n);
  return tenColour(first);
}

void addColours(std::span<Segmented> maps) {
  const auto isTaken = [&](glm::u8vec3 colour) {
    return std::ranges::any_of(maps, [&](const Segmented& map) {
      return std::ranges::find(map.segments, colour, &Segment::colour) != map.segments.end();
    });
  };
  for (Segmented& map : maps)
    for (Segment& segment : map.segments)
      if (!segment.colour) segment.colour = freeTenColour(segment.number, isTaken);
}

NamesGiven addNames(std::span<Segmented> maps) {
  NamesGiven given;
  std::set<std::string> files, taken;
  for (const Segmented& map : maps)
    for (const Segment& segment : map.segments) files.insert(segment.label);
  for (Segmented& map : maps)
    for (Segment& segment : map.segments) {
      const bool isUnnamed = isBlank(segment.label);
      const std::string wanted = isUnnamed ? "Segment " + std::to_string(segment.number) : segment.label;
      if (!isUnnamed && taken.insert(wanted).second) continue;
      segment.label = freeName(wanted, [&](const std::string& name) {
        return files.contains(name) || !taken.insert(name).second;
      });
      (isUnnamed ? given.unnamed : given.alike).push_back(segment.label);
    }
  return given;
}

}  // namespace volumen
