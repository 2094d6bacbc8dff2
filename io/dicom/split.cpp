#include "io/dicom/split.h"

#include <algorithm>
#include <map>
#include <set>

#include "io/dicom/interleaved.h"
#include "io/dicom/volume_order.h"
#include "io/dicom/whole_stacks.h"
#include "io/study/natural_order.h"

namespace volumen::dicom {

bool isBefore(const std::string& a, const std::string& b) {
  const auto x = parseNumber(a), y = parseNumber(b);
  if (x && y && *x != *y) return *x < *y;
  if (x.has_value() != y.has_value()) return x.has_value();
  return naturalOrder(a, b) < 0;
}

void addName(Split& split, const Separator& separator, const std::string& value, const std::string& words) {
  split.by.push_back({separator.keyword, value, words});
  if (separator.field == &Series::timePoint && split.timePoint.empty()) split.timePoint = value;
  if (!separator.field) split.label += (split.label.empty() ? "" : ", ") + words;
}

namespace {

using Trust = Separator::Trust;

const std::string& valueOf(const Entry& e, std::size_t separator) { return e.slice().separators[separator]; }

/// Returns the distinct values in order; directions in order of first occurrence.
std::vector<std::string> valuesOf(const Entries& entries, std::size_t separator) {
  std::vector<std::string> values;
  std::set<std::string> seen;
  for (const Entry& e : entries)
    if (seen.insert(valueOf(e, separator)).second) values.push_back(valueOf(e, separator));
  if (separators()[separator].words != Separator::Words::direction) std::ranges::sort(values, isBefore);
  return values;
}

bool differsAtOnePlace(const Entries& entries, std::size_t separator) {
  return std::ranges::any_of(byPlace(entries), [&](const Entries& place) {
    return std::ranges::any_of(
        place, [&](const Entry& e) { return valueOf(e, separator) != valueOf(place[0], separator); });
  });
}

/// Splits by the values of one separator. `all` holds the values among which they are worded.
std::vector<Split> byValue(const Split& split, std::size_t n, const std::vector<std::string>& all) {
  const Separator& separator = separators()[n];
  const std::vector<std::string> values = valuesOf(split.entries, n);
  if (values.size() == 1) return {split};
  std::map<std::string, std::size_t> index;
  std::vector<Split> splits(values.size(), Split{{}, split.by, split.timePoint, split.label, {}, false});
  for (std::size_t v = 0; v < values.size(); ++v) {
    index[values[v]] = v;
    const auto at = std::size_t(std::ranges::find(all, values[v]) - all.begin());
    addName(splits[v], separator, values[v], wordsOf(separator, all, at));
  }
  for (const Entry& e : split.entries) splits[index[valueOf(e, n)]].entries.push_back(e);
  return splits;
}

std::string ordinal(std::size_t n, std::size_t of) {
  return std::to_string(n + 1) + " of " + std::to_string(of);
}

/// Assigns the n-th picture at each position, in the order of `before`, to the n-th split.
template <class Before>
std::vector<Entries> byOrder(const Entries& entries, Before before) {
  std::vector<Entries> ranks;
  for (Entries& place : byPlace(entries)) {
    std::stable_sort(place.begin(), place.end(), before);
    ranks.resize(std::max(ranks.size(), place.size()));
    for (std::size_t n = 0; n < place.size(); ++n) ranks[n].push_back(place[n]);
  }
  return ranks;
}

/// Returns whether every position has the same number of pictures, each with its own number. Either all
/// numbers are the same at all positions, or at most one is, such as time 0, and all others occur once.
/// Otherwise pictures are missing.
bool countsEverywhere(const Entries& entries, std::size_t separator) {
  const std::vector<Entries> places = byPlace(entries);
  const std::size_t most = mostAtOnePlace(entries);
  // Rank of each number and how many positions have it.
  std::map<double, std::pair<std::size_t, std::size_t>> ranks;
  for (const Entries& place : places) {
    std::set<double> numbers;
    for (const Entry& e : place)
      if (const auto number = parseNumber(valueOf(e, separator))) numbers.insert(*number);
    if (place.size() != most || numbers.size() != most) return false;
    std::size_t rank = 0;
    for (const double number : numbers) {
      const auto [it, isNew] = ranks.emplace(number, std::pair(rank, std::size_t(0)));
      if (it->second.first != rank++) return false;
      ++it->second.second;
    }
  }
  const auto shared =
      std::ranges::count_if(ranks, [&](const auto& of) { return of.second.second == places.size(); });
  const auto single = std::ranges::count_if(ranks, [](const auto& of) { return of.second.second == 1; });
  if (shared == std::ptrdiff_t(ranks.size())) return true;
  return shared <= 1 && shared + single == std::ptrdiff_t(ranks.size());
}

std::vector<Split> byCount(const Split& split, std::size_t n) {
  const Separator& separator = separators()[n];
  const std::vector<Entries> ranks = byOrder(
      split.entries, [n](const Entry& a, const Entry& b) { return isBefore(valueOf(a, n), valueOf(b, n)); });
  std::vector<Split> splits;
  for (std::size_t r = 0; r < ranks.size(); ++r) {
    splits.push_back({ranks[r], split.by, split.timePoint, split.label, {}, false, true});
    const std::string number = ordinal(r, ranks.size());
    addName(splits.back(), separator, number, separator.before + number);
  }
  return splits;
}

/// Names parts that only their rank separates. `how` says in words by which property.
std::vector<Split> byRank(const Split& split, const std::vector<Entries>& ranks, const std::string& how) {
  std::vector<Split> splits;
  for (std::size_t r = 0; r < ranks.size(); ++r) {
    const std::string words = ordinal(r, ranks.size());
    splits.push_back({ranks[r], split.by, split.timePoint, split.label, {}, false});
    splits.back().by.push_back({"rank", words, words});
    splits.back().label += (split.label.empty() ? "" : ", ") + words;
    splits.back().warning =
        std::to_string(ranks.size()) +
        " pictures lie at one place, and no attribute that is compared tells which belong "
        "together: they were taken " +
        how + ".";
  }
  return splits;
}

/// Splits by image number as a last resort. If two pictures at one position share it, splits by file or
/// folder, else keeps the pictures together as frames.
std::vector<Split> byNumber(const Split& split) {
  const auto number = [](const Entry& e) { return e.slice().instance; };
  const bool tie = std::ranges::any_of(byPlace(split.entries), [&](const Entries& place) {
    std::set<long> numbers;
    for (const Entry& e : place) numbers.insert(number(e));
    return numbers.size() < place.size();
  });
  if (!tie) {
    const auto ranks =
        byOrder(split.entries, [&](const Entry& a, const Entry& b) { return number(a) < number(b); });
    return byRank(split, ranks, "in the order of their image numbers");
  }
  if (const auto files = stacksOfFiles(split.entries, false); !files.empty())
    return byRank(split, files, "file by file");
  if (const auto folders = stacksOfFolders(split.entries); !folders.empty())
    return byRank(split, folders, "by their folders");
  Split frames = split;
  frames.isGuess = true;
  return {frames};
}

/// Returns whether a separator explains repeated positions. It must have no more values than there are
/// pictures at a position, or each value must make a stack. Each value must have fewer pictures at a
/// position.
bool explains(const Entries& entries, std::size_t separator) {
  const std::size_t most = mostAtOnePlace(entries);
  const std::vector<std::string> values = valuesOf(entries, separator);
  if (values.size() < 2) return false;
  const bool makesStacks = separators()[separator].along == Separator::Along::steady &&
                           areEvenStacks(entries, kindsOf(entries, separator));
  if (values.size() > most && !makesStacks) return false;
  const std::vector<Split> splits = byValue({entries, {}, {}, {}, {}, false}, separator, values);
  return std::ranges::all_of(splits, [&](const Split& s) { return mostAtOnePlace(s.entries) < most; });
}

/// Returns whether several pictures share a position.
bool repeats(const Split& split) { return mostAtOnePlace(split.entries) > 1; }

/// Splits those for which `is` holds by one separator and keeps the others.
template <class Is>
std::vector<Split> eachByValue(const std::vector<Split>& splits, std::size_t n, Is is) {
  Entries all;
  for (const Split& split : splits) std::ranges::copy(split.entries, std::back_inserter(all));
  const std::vector<std::string> values = valuesOf(all, n);
  std::vector<Split> inner;
  for (const Split& split : splits)
    if (is(split))
      std::ranges::move(byValue(split, n, values), std::back_inserter(inner));
    else
      inner.push_back(split);
  return inner;
}

/// Splits by a separator that explains repeats in one of the splits, there and where the same values occur.
/// Returns false if no separator does.
bool splitByOneMore(std::vector<Split>& splits) {
  for (std::size_t n = 0; n < separators().size(); ++n) {
    const auto isExplained = [&](const Split& s) { return repeats(s) && explains(s.entries, n); };
    const auto first = std::ranges::find_if(splits, isExplained);
    if (first == splits.end()) continue;
    const std::vector<std::string> explained = valuesOf(first->entries, n);
    splits = eachByValue(splits, n, [&](const Split& s) {
      const std::vector<std::string> own = valuesOf(s.entries, n);
      return isExplained(s) || std::ranges::all_of(own, [&](const std::string& value) {
               return std::ranges::find(explained, value) != explained.end();
             });
    });
    return true;
  }
  return false;
}

/// Splits by the order of a separator's values at each position, else by image number.
std::vector<Split> splitTheRest(const Split& split) {
  for (std::size_t n = 0; n < separators().size(); ++n)
    if (separators()[n].along == Separator::Along::counts && countsEverywhere(split.entries, n))
      return byCount(split, n);
  return byNumber(split);
}

/// Returns whether pictures of a volume that differ in separator `n` may not belong together because files
/// are missing. `most` is the number of pictures at one position. Image types and times differ within volumes
/// too.
bool wouldBeMixed(const Entries& entries, std::size_t n, std::size_t most) {
  const Separator& separator = separators()[n];
  if (separator.words == Separator::Words::imageType) return false;
  if (separator.trust == Trust::certain) return true;
  if (most == 1 || separator.trust == Trust::always) return false;
  return separator.trust == Trust::likely ||
         (valuesOf(entries, n).size() <= most && differsAtOnePlace(entries, n));
}

/// Warns of attributes that should not differ within a volume. `mixing` are those that suggest missing files.
void warnOfMixture(const std::vector<std::size_t>& mixing, Split& split) {
  if (!split.warning.empty()) return;
  std::string back, missing;
  const auto add = [](std::string& to, const char* keyword) {
    to += (to.empty() ? "" : ", ") + std::string(keyword);
  };
  for (std::size_t n = 0; n < separators().size(); ++n) {
    const Separator& separator = separators()[n];
    if (split.isCounted && separator.along != Separator::Along::steady) continue;
    if (goesBackAndForth(split.entries, n))
      add(back, separator.keyword);
    else if (!split.isCounted && std::ranges::find(mixing, n) != mixing.end() &&
             valuesOf(split.entries, n).size() > 1)
      add(missing, separator.keyword);
  }
  if (!back.empty())
    split.warning = "Its pictures differ in " + back + " back and forth: they may not belong together.";
  else if (!missing.empty())
    split.warning =
        "Its pictures differ in " + missing + ": they may not belong together, and others may be missing.";
}

/// Splits by all attributes that reliably separate pictures.
std::vector<Split> splitSurely(const Entries& entries) {
  std::vector<Split> splits{{entries, {}, {}, {}, {}, false}};
  const std::size_t most = mostAtOnePlace(entries);
  for (std::size_t n = 0; n < separators().size(); ++n) {
    const Trust trust = separators()[n].trust;
    if (trust == Trust::needed || (trust != Trust::always && most == 1)) continue;
    if (trust != Trust::always && !differsAtOnePlace(entries, n)) continue;
    if (trust == Trust::likely && valuesOf(entries, n).size() > most) continue;
    splits = eachByValue(splits, n, [](const Split&) { return true; });
  }
  return splits;
}

/// Adds image types to the names of echoes that also differ in type, such as a field map beside a magnitude.
void nameKindsOfEchoes(std::vector<Split>& splits) {
  const auto all = separators();
  const auto type =
      std::size_t(std::ranges::find(all, Separator::Words::imageType, &Separator::words) - all.begin());
  const auto isBy = [](const Split& s, std::string_view keyword) {
    return std::ranges::any_of(s.by, [&](const SplitBy& by) { return by.attribute == keyword; });
  };
  Entries entries;
  for (const Split& split : splits) {
    if (!isBy(split, "EchoTime") || isBy(split, all[type].keyword) ||
        valuesOf(split.entries, type).size() > 1)
      return;
    std::ranges::copy(split.entries, std::back_inserter(entries));
  }
  const std::vector<std::string> types = valuesOf(entries, type);
  if (types.size() < 2) return;
  for (Split& split : splits) {
    const std::string& own = valueOf(split.entries[0], type);
    const auto at = std::size_t(std::ranges::find(types, own) - types.begin());
    if (const std::string words = wordsOf(all[type], types, at); !words.empty())
      addName(split, all[type], own, words);
  }
}

/// Splits pictures that may share positions.
std::vector<Split> splitAtPlaces(const Entries& entries) {
  std::vector<Split> splits = splitSurely(entries), all;
  while (splitByOneMore(splits)) {
  }
  orderByNumbers(splits);
  nameKindsOfEchoes(splits);
  for (const Split& split : splits)
    std::ranges::move(repeats(split) ? splitTheRest(split) : std::vector{split}, std::back_inserter(all));
  return all;
}

/// Splits stacks that are each a volume, as if each were one picture at one position.
std::vector<Split> splitStacks(const std::vector<Entries>& stacks) {
  Entries firsts;
  for (const Entries& stack : stacks) {
    firsts.push_back(stack.front());
    firsts.back().placed.alongNormal = 0;
    Slice slice = stack.front().slice();
    slice.instance = firstNumber(stack);
    firsts.back().placed.slice = SharedSlice(std::move(slice));
  }
  const auto stackOf = [&](const Entry& e) {
    return *std::ranges::find_if(stacks, [&](const Entries& stack) {
      return stack.front().file == e.file && stack.front().slice().frame == e.slice().frame;
    });
  };
  std::vector<Split> all;
  for (const Split& split : splitAtPlaces(firsts)) {
    std::vector<Entries> ranks;
    for (const Entry& e : split.entries) ranks.push_back({e});
    for (Split& one : split.isGuess ? byRank(split, ranks, {}) : std::vector{split}) {
      one.entries = stackOf(one.entries[0]);
      one.warning.clear();
      all.push_back(std::move(one));
    }
  }
  return all;
}

}  // namespace

std::vector<Split> splitRepeats(const Entries& entries) {
  const std::vector<Entries> stacks = stacksOfFiles(entries);
  std::vector<Split> splits = stacks.empty() ? splitAtPlaces(entries) : splitStacks(stacks);
  std::vector<std::size_t> mixing;
  const std::size_t most = stacks.empty() ? mostAtOnePlace(entries) : 1;
  for (std::size_t n = 0; n < separators().size(); ++n)
    if (wouldBeMixed(entries, n, most)) mixing.push_back(n);
  std::vector<Split> all;
  for (const Split& split : splits)
    for (Split& part : split.isGuess ? std::vector{split} : splitInterleaved(split)) {
      if (!part.isGuess) warnOfMixture(mixing, part);
      all.push_back(std::move(part));
    }
  return all;
}

}  // namespace volumen::dicom
