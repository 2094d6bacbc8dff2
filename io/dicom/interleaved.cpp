#include "io/dicom/interleaved.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "io/dicom/moments.h"

namespace volumen::dicom {
namespace {

using Along = Separator::Along;
using Words = Separator::Words;

/// Returns the seconds of a time of day, with or without a date before it.
std::optional<double> clockSeconds(const std::string& text) {
  const DateTime parts = partsOf(text);
  const auto whole = moment(parts.date, parts.time);
  return whole ? whole : timeSeconds(text);
}

/// Returns the largest gap between numbers of one kind. Sizes are rounded. MR slices are acquired in turn,
/// others one after the other, apart from the jitter of their clocks. Reconstruction times say less.
double apartFrom(double number, const Separator& separator, const std::string& modality) {
  constexpr double rounding = 0.02, jitter = 10, oneAcquisition = 600;  // the last two in seconds
  if (separator.words == Words::size) return rounding * number;
  return separator.along == Along::counts && modality != "MR" ? jitter : oneAcquisition;
}

/// Maps each value to the first value of its kind.
std::map<std::string, std::string> firstOfKind(const Entries& entries, std::size_t separator) {
  const Words words = separators()[separator].words;
  std::map<std::string, std::string> first;
  for (const Entry& e : entries)
    first.emplace(e.slice().separators[separator], e.slice().separators[separator]);
  if (words != Words::size && words != Words::clock) return first;
  std::multimap<double, std::string> numbers;
  for (const auto& [value, of] : first)
    if (const auto number = words == Words::clock ? clockSeconds(value) : parseNumber(value))
      numbers.emplace(*number, value);
  const std::string* kind = nullptr;
  double last = 0;
  for (const auto& [number, value] : numbers) {
    if (!kind || number - last > apartFrom(number, separators()[separator], entries[0].file->modality))
      kind = &value;
    first[value] = *kind;
    last = number;
  }
  return first;
}

/// Returns the indices of the pictures of each kind.
std::vector<std::vector<std::size_t>> standing(const Kinds& kinds) {
  std::vector<std::vector<std::size_t>> at(kinds.values.size());
  for (std::size_t n = 0; n < kinds.of.size(); ++n) at[kinds.of[n]].push_back(n);
  return at;
}

std::vector<double> stepsOf(const Entries& entries, const std::vector<std::size_t>& at) {
  std::vector<double> steps;
  for (std::size_t n = 1; n < at.size(); ++n)
    steps.push_back(entries[at[n]].placed.alongNormal - entries[at[n - 1]].placed.alongNormal);
  return steps;
}

/// Returns whether positions are even; a quarter of the slices may be missing.
bool areEven(const std::vector<double>& steps) {
  constexpr double jitter = 0.05, mostMissing = 0.25;
  if (steps.empty()) return true;
  const double step = lowerMedian(steps);
  if (!(step > 0)) return false;
  double missing = 0;
  for (const double s : steps) {
    const double count = std::round(s / step);
    if (count < 1 || std::abs(s - count * step) > jitter * step) return false;
    missing += count - 1;
  }
  return missing <= mostMissing * double(steps.size() + 1);
}

/// The number of pictures of other kinds between those of one kind.
struct Between {
  std::size_t inSteps = 0, inHoles = 0;  ///< within regular steps; where slices of the kind are missing
};

Between between(const std::vector<std::size_t>& at, const std::vector<double>& steps) {
  Between found;
  if (steps.empty()) return found;
  const double hole = 1.5 * lowerMedian(steps);
  for (std::size_t n = 0; n < steps.size(); ++n)
    (steps[n] > hole ? found.inHoles : found.inSteps) += at[n + 1] - at[n] - 1;
  return found;
}

std::size_t changes(const Kinds& kinds) {
  std::size_t count = 0;
  for (std::size_t n = 1; n < kinds.of.size(); ++n) count += kinds.of[n] != kinds.of[n - 1];
  return count;
}

/// Returns whether the kinds repeat in a fixed order.
bool isPeriodic(const Kinds& kinds) {
  constexpr std::size_t longest = 64, times = 3;
  const std::size_t count = kinds.of.size();
  for (std::size_t period = 2; period <= std::min(longest, count / times); ++period)
    if (std::equal(kinds.of.begin() + std::ptrdiff_t(period), kinds.of.end(), kinds.of.begin())) return true;
  return false;
}

bool allEven(const Entries& entries) {
  std::vector<std::size_t> all(entries.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  return areEven(stepsOf(entries, all));
}

/// Splits by kind, in order of first position. If these only jitter, the order is that of the values.
std::vector<Split> byKinds(const Split& split, std::size_t separator, const Kinds& kinds) {
  std::vector<Split> splits(kinds.values.size(),
                            Split{{}, split.by, split.timePoint, split.label, {}, false});
  for (std::size_t n = 0; n < kinds.of.size(); ++n) splits[kinds.of[n]].entries.push_back(split.entries[n]);
  for (std::size_t k = 0; k < splits.size(); ++k)
    addName(splits[k], separators()[separator], kinds.values[k],
            wordsOf(separators()[separator], kinds.values, k));
  constexpr double tremble = 0.25;  // fraction of a step
  const std::vector<double> steps = stepsOf(split.entries, standing(kinds)[0]);
  const auto placeOf = [](const Split& s) { return s.entries[0].placed.alongNormal; };
  if (placeOf(splits.back()) - placeOf(splits.front()) < tremble * lowerMedian(steps))
    std::ranges::stable_sort(splits, isBefore, [](const Split& s) { return s.by.back().value; });
  return splits;
}

}  // namespace

Kinds kindsOf(const Entries& entries, std::size_t separator) {
  const std::string& one = entries[0].slice().separators[separator];
  if (std::ranges::all_of(entries, [&](const Entry& e) { return e.slice().separators[separator] == one; }))
    return {std::vector<std::size_t>(entries.size()), {one}};
  const std::map<std::string, std::string> first = firstOfKind(entries, separator);
  std::map<std::string, std::size_t> number;
  Kinds kinds;
  for (const Entry& e : entries) {
    const std::string& value = e.slice().separators[separator];
    const auto [at, isNew] = number.emplace(first.at(value), kinds.values.size());
    if (isNew) kinds.values.push_back(value);
    kinds.of.push_back(at->second);
  }
  return kinds;
}

bool areEvenStacks(const Entries& entries, const Kinds& kinds) {
  constexpr std::size_t least = 3;
  const auto all = standing(kinds);
  return std::ranges::all_of(all, [&](const std::vector<std::size_t>& at) {
    return at.size() >= least && areEven(stepsOf(entries, at));
  });
}

bool areStacksInEachOther(const Entries& entries, const Kinds& kinds) {
  constexpr std::size_t leastChanges = 4;
  if (kinds.values.size() < 2 || changes(kinds) < leastChanges || !areEvenStacks(entries, kinds))
    return false;
  std::size_t inSteps = 0;
  for (const std::vector<std::size_t>& at : standing(kinds)) {
    const Between others = between(at, stepsOf(entries, at));
    if (others.inHoles > others.inSteps) return false;
    inSteps += others.inSteps;
  }
  return inSteps > 0;
}

std::vector<Split> splitInterleaved(const Split& split) {
  const Entries& entries = split.entries;
  if (entries.size() < 6) return {split};
  const bool isEven = allEven(entries);
  for (std::size_t n = 0; n < separators().size(); ++n) {
    if (isEven && separators()[n].along != Along::steady) continue;
    const Kinds kinds = kindsOf(entries, n);
    if (!areStacksInEachOther(entries, kinds)) continue;
    std::vector<Split> all;
    for (const Split& part : byKinds(split, n, kinds))
      std::ranges::move(splitInterleaved(part), std::back_inserter(all));
    return all;
  }
  return {split};
}

bool goesBackAndForth(const Entries& entries, std::size_t separator) {
  const Separator& s = separators()[separator];
  const Kinds kinds = kindsOf(entries, separator);
  if (kinds.values.size() < 2) return false;
  // Image types and times differ within volumes too.
  const std::size_t back = changes(kinds) - (kinds.values.size() - 1),
                    most = std::max<std::size_t>(2, entries.size() / 3);
  if (s.words == Words::imageType || s.words == Words::clock) return back >= most;
  if (s.along != Along::steady) return isPeriodic(kinds) || areStacksInEachOther(entries, kinds);
  if (back >= 2) return true;
  const auto all = standing(kinds);
  return std::ranges::any_of(all, [&](const std::vector<std::size_t>& at) {
    return at.size() > 2 && between(at, stepsOf(entries, at)).inSteps > 0;
  });
}

}  // namespace volumen::dicom
