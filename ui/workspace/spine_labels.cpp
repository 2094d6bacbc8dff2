#include "ui/workspace/spine_labels.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>

namespace volumen {

namespace {

std::vector<std::string> spine() {
  std::vector<std::string> all;
  for (const auto& [letter, count] : {std::pair('C', 7), {'T', 12}, {'L', 5}, {'S', 5}})
    for (int n = 1; n <= count; ++n) all.push_back(letter + std::to_string(n));
  return all;
}

// Returns the index in the spine; -1 if it is no vertebra.
int placeInSpine(const std::string& name) {
  const auto all = vertebrae();
  const auto found = std::ranges::find(all, name);
  return found == all.end() ? -1 : int(found - all.begin());
}

std::string numberedOn(const std::string& name) {
  const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t at = name.size();
  while (at > 0 && isDigit(name[at - 1])) --at;
  int number = 0;
  const auto read = std::from_chars(name.data() + at, name.data() + name.size(), number);
  if (at == name.size() || read.ec != std::errc() || number == std::numeric_limits<int>::max()) return {};
  return name.substr(0, at) + std::to_string(number + 1);
}

}  // namespace

std::span<const std::string> vertebrae() {
  static const std::vector<std::string> all = spine();
  return all;
}

std::string nextLabel(const Workspace& workspace, const SeriesKey& series) {
  std::vector<std::string> names;
  for (const Measurement& m : workspace.measurements)
    if (m.shape.kind == ShapeKind::label && m.series == series) names.push_back(m.shape.name);
  if (names.empty()) return "C7";
  const int last = placeInSpine(names.back());
  if (last < 0) return numberedOn(names.back());
  const int before = names.size() > 1 ? placeInSpine(names[names.size() - 2]) : -1;
  const int next = last + (before == last + 1 ? -1 : 1);
  return next >= 0 && next < int(vertebrae().size()) ? vertebrae()[std::size_t(next)] : std::string();
}

}  // namespace volumen
