#include "io/dicom/whole_stacks.h"

#include <algorithm>
#include <limits>
#include <map>

namespace volumen::dicom {
namespace {

/// Groups entries by a key, in order of numbers and names.
template <class Key>
std::vector<Entries> grouped(const Entries& entries, Key key) {
  std::map<std::string, std::size_t> index;
  std::vector<Entries> groups;
  for (const Entry& e : entries) {
    const auto [at, isNew] = index.emplace(key(e), groups.size());
    if (isNew) groups.emplace_back();
    groups[at->second].push_back(e);
  }
  std::ranges::stable_sort(
      groups, {}, [](const Entries& group) { return std::pair(firstNumber(group), group[0].file->path); });
  return groups;
}

/// Returns whether there are several groups and each is a stack of several positions.
bool areStacks(const std::vector<Entries>& groups) {
  return groups.size() > 1 && std::ranges::all_of(groups, [](const Entries& group) {
           return group.size() > 1 && mostAtOnePlace(group) == 1;
         });
}

/// Returns whether all groups extend over a common position.
bool shareAPlace(const std::vector<Entries>& groups) {
  double from = std::numeric_limits<double>::lowest(), to = std::numeric_limits<double>::max();
  for (const Entries& group : groups) {
    from = std::max(from, group.front().placed.alongNormal);
    to = std::min(to, group.back().placed.alongNormal);
  }
  return from <= to + samePlaceMm(groups[0]);
}

}  // namespace

std::vector<Entries> stacksOfFiles(const Entries& entries, bool reachOverOne) {
  std::vector<Entries> groups = grouped(entries, [](const Entry& e) {
    return e.file->concatenation.uid.empty() ? e.file->path : "concatenation " + e.file->concatenation.uid;
  });
  const bool areMosaics =
      std::ranges::all_of(entries, [](const Entry& e) { return e.file->mosaic.has_value(); });
  if (!areStacks(groups) || (reachOverOne && !areMosaics && !shareAPlace(groups))) groups.clear();
  return groups;
}

std::vector<Entries> stacksOfFolders(const Entries& entries) {
  std::vector<Entries> groups = grouped(
      entries, [](const Entry& e) { return e.file->path.substr(0, e.file->path.find_last_of('/') + 1); });
  if (!areStacks(groups)) groups.clear();
  return groups;
}

}  // namespace volumen::dicom
