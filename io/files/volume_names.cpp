#include "io/files/volume_names.h"

namespace volumen {

namespace {

void addName(const OuterAxis& axis, std::uint64_t n, VolumeName& name) {
  const std::string number = std::to_string(n + 1);
  std::string words;
  switch (axis.kind) {
    case OuterAxis::Kind::time:
      name.timePoint = number;
      return;
    case OuterAxis::Kind::component:
      words = "component " + (axis.size <= 3 ? std::string(1, "xyz"[n]) : number);
      break;
    case OuterAxis::Kind::direction:
      words = "direction " + number;
      break;
    case OuterAxis::Kind::other:
      words = number + " of " + std::to_string(axis.size);
      break;
  }
  name.label += (name.label.empty() ? "" : ", ") + words;
}

}  // namespace

std::vector<VolumeName> volumeNames(const std::vector<OuterAxis>& axes) {
  std::uint64_t count = 1;
  for (const OuterAxis& axis : axes) count *= axis.size;
  std::vector<VolumeName> names(count);
  for (std::uint64_t volume = 0; volume < count; ++volume) {
    std::uint64_t rest = volume;
    for (const OuterAxis& axis : axes) {
      if (axis.size > 1) addName(axis, rest % axis.size, names[volume]);
      rest /= axis.size;
    }
  }
  return names;
}

}  // namespace volumen
