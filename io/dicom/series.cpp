#include "io/dicom/series.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "io/dicom/parts.h"
#include "io/regular_file.h"

namespace volumen::dicom {
namespace {

/// A picture with the file it comes from.
struct Entry {
  const FileHeader* file;
  PlacedSlice placed;
  const Slice& slice() const { return placed.slice; }
};
using Entries = std::vector<Entry>;

bool near(glm::dvec3 a, glm::dvec3 b, double tolerance) { return glm::length(a - b) <= tolerance; }

/// Whether two pictures can be slices of one volume, place aside.
bool fit(const Entry& a, const Entry& b) {
  const Slice &s = a.slice(), &t = b.slice();
  if (a.file->format.columns != b.file->format.columns || a.file->format.rows != b.file->format.rows)
    return false;
  if (s.echo != t.echo) return false;
  if (isPlaced(s) != isPlaced(t)) return false;
  if (!isPlaced(s)) return true;
  // Orientations are given with six digits or so; 1e-3 is 0.25 mm at the edge of a 500 mm picture.
  return near(s.orientation->row, t.orientation->row, 1e-3) &&
         near(s.orientation->column, t.orientation->column, 1e-3) &&
         glm::length(*s.spacing - *t.spacing) <= 1e-3 * glm::length(*s.spacing);
}

std::string seriesKey(const FileHeader& file) {
  if (file.seriesUid.empty()) return "file " + file.path;
  return "series " + file.studyUid + "/" + file.seriesUid;
}

std::vector<Entries> groups(const std::vector<FileHeader>& files) {
  std::map<std::string, std::vector<Entries>> bySeries;
  for (const FileHeader& file : files) {
    std::vector<Entries>& known = bySeries[seriesKey(file)];
    for (const Slice& slice : file.slices) {
      Entry entry{&file, {slice, file.path, 0}};
      // Only the last groups are tried, so that a file of a hundred thousand directions takes no minutes.
      const auto first = known.end() - std::min<std::ptrdiff_t>(256, known.end() - known.begin());
      const auto it = std::find_if(first, known.end(), [&](const Entries& g) { return fit(g[0], entry); });
      if (it == known.end())
        known.push_back({entry});
      else
        it->push_back(entry);
    }
  }
  std::vector<Entries> all;
  for (auto& [key, parts] : bySeries)
    for (Entries& part : parts) all.push_back(std::move(part));
  return all;
}

/// Along row x column where slices have a place, else by InstanceNumber and name.
void order(Entries& entries) {
  const Slice first = entries[0].slice();
  const bool placed = isPlaced(first);
  const glm::dvec3 normal =
      placed ? glm::cross(first.orientation->row, first.orientation->column) : glm::dvec3(0);
  for (Entry& e : entries) e.placed.alongNormal = placed ? glm::dot(*e.slice().position, normal) : 0;
  const auto key = [](const Entry& e) {
    return std::tie(e.placed.alongNormal, e.slice().instance, e.file->path, e.slice().frame);
  };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const Entry& a, const Entry& b) { return key(a) < key(b); });
  if (placed) return;
  const bool numbered = std::ranges::all_of(entries, [](const Entry& e) { return e.slice().inStack > 0; });
  for (std::size_t n = 0; n < entries.size(); ++n)
    entries[n].placed.alongNormal = numbered ? double(entries[n].slice().inStack) : double(n);
  std::ranges::stable_sort(entries, {}, [](const Entry& e) { return e.placed.alongNormal; });
}

/// Distances below this are none, mm.
double samePlaceMm(const Entries& entries) {
  const Slice& s = entries[0].slice();
  return isPlaced(s) ? 0.01 * std::min(s.spacing->x, s.spacing->y) : 0.5;
}

/// Sorted entries by place: each a run of pictures at one place.
std::vector<Entries> byPlace(const Entries& entries) {
  std::vector<Entries> places;
  const double same = samePlaceMm(entries);
  for (const Entry& e : entries) {
    if (places.empty() || e.placed.alongNormal - places.back()[0].placed.alongNormal > same)
      places.emplace_back();
    places.back().push_back(e);
  }
  return places;
}

std::size_t mostAtOnePlace(const Entries& entries) {
  std::size_t most = 0;
  for (const Entries& place : byPlace(entries)) most = std::max(most, place.size());
  return most;
}

/// Drops pictures that are in the study twice (same SOPInstanceUID, frame, place and rescale).
std::vector<std::string> dropCopies(Entries& entries) {
  std::vector<std::string> warnings;
  std::map<std::tuple<std::string, int, double, double, double>, const FileHeader*> seen;
  std::size_t copies = 0;
  Entries kept;
  for (const Entry& e : entries) {
    const auto key = std::make_tuple(e.file->sopInstanceUid, e.slice().frame, e.placed.alongNormal,
                                     e.slice().slope, e.slice().intercept);
    const auto [it, isNew] = seen.emplace(key, e.file);
    if (isNew || e.file->sopInstanceUid.empty()) {
      kept.push_back(e);
    } else if (copies++ == 0) {
      warnings.push_back(fileName(e.file->path) + " is a copy of " + fileName(it->second->path) +
                         " and is left out");
    }
  }
  if (copies > 1) warnings.back() += ", and so are " + std::to_string(copies - 1) + " other copies";
  if (copies) warnings.back() += ".";
  entries = std::move(kept);
  return warnings;
}

/// Pictures of which none lies where another does, and what tells them from those that do.
struct Split {
  Entries entries;
  PartName name;
};

/// Splits by one attribute, in order of first occurrence.
std::vector<Split> byPart(const Entries& entries, std::size_t part) {
  std::map<std::string, std::size_t> index;
  std::vector<std::string> values;
  std::vector<Split> splits;
  for (const Entry& e : entries) {
    const auto [it, isNew] = index.emplace(e.slice().parts[part], splits.size());
    if (isNew) splits.emplace_back(), values.push_back(it->first);
    splits[it->second].entries.push_back(e);
  }
  for (std::size_t n = 0; n < splits.size(); ++n) splits[n].name = partName(part, values, n);
  return splits;
}

/// Pictures of one place by their order there: the first of each place, the second of each place, ...
std::vector<Split> byRank(const Entries& entries) {
  std::vector<Split> ranks;
  for (const Entries& place : byPlace(entries)) {
    Entries inOrder = place;
    std::stable_sort(inOrder.begin(), inOrder.end(),
                     [](const Entry& a, const Entry& b) { return a.slice().instance < b.slice().instance; });
    ranks.resize(std::max(ranks.size(), inOrder.size()));
    for (std::size_t n = 0; n < inOrder.size(); ++n) ranks[n].entries.push_back(inOrder[n]);
  }
  for (std::size_t n = 0; n < ranks.size(); ++n)
    ranks[n].name.label = std::to_string(n + 1) + " of " + std::to_string(ranks.size());
  return ranks;
}

std::vector<Split> splitRepeats(const Entries& entries);

/// Splits what is split already once more; names follow each other.
std::vector<Split> splitFurther(const std::vector<Split>& splits) {
  std::vector<Split> all;
  for (const Split& split : splits)
    for (Split& inner : splitRepeats(split.entries)) {
      if (inner.name.timePoint.empty()) inner.name.timePoint = split.name.timePoint;
      const bool both = !split.name.label.empty() && !inner.name.label.empty();
      inner.name.label = split.name.label + (both ? ", " : "") + inner.name.label;
      all.push_back(std::move(inner));
    }
  return all;
}

/// Parts of which none holds two pictures of one place.
std::vector<Split> splitRepeats(const Entries& entries) {
  const std::size_t most = mostAtOnePlace(entries);
  if (most == 1) return {{entries, {}}};
  for (std::size_t part = 0; part < entries[0].slice().parts.size(); ++part) {
    const std::vector<Split> splits = byPart(entries, part);
    // An attribute explains the repetition where it makes no more parts than there are pictures at a place.
    const bool explains = splits.size() > 1 && splits.size() <= most &&
                          std::all_of(splits.begin(), splits.end(),
                                      [&](const Split& s) { return mostAtOnePlace(s.entries) < most; });
    if (explains) return splitFurther(splits);
  }
  return byRank(entries);
}

std::vector<PlacedSlice> placedSlices(const Entries& entries) {
  std::vector<PlacedSlice> slices;
  for (const Entry& e : entries) slices.push_back(e.placed);
  return slices;
}

/// A volume to be: its slices and what was noticed on the way.
struct Part {
  Entries entries;
  std::vector<std::string> warnings;
  PartName name = {};
};

/// Cuts at gaps of more than 4 usual distances, or more than 20 mm beyond the usual one (design.md 10).
std::vector<Part> splitGaps(const Entries& entries) {
  std::vector<Part> parts(1);
  if (!isPlaced(entries[0].slice()) || entries.size() < 3) return {{entries, {}, {}}};
  const std::vector<double> steps = stepsMm(placedSlices(entries));
  const double median = lowerMedian(steps);
  for (std::size_t n = 0; n < entries.size(); ++n) {
    parts.back().entries.push_back(entries[n]);
    if (n == steps.size() || (steps[n] <= 4 * median && steps[n] <= median + 20)) continue;
    const std::string gap = "Gap of " + millimetres(steps[n]) + " mm between " +
                            fileName(entries[n].file->path) + " and " + fileName(entries[n + 1].file->path) +
                            ": the slices on either side are series of their own.";
    parts.back().warnings.push_back(gap);
    parts.push_back({{}, {gap}, {}});
  }
  return parts;
}

std::string commonFolder(const std::vector<std::string>& files) {
  if (std::all_of(files.begin(), files.end(), [&](const std::string& f) { return f == files[0]; }))
    return files[0];
  std::string common = files[0].substr(0, files[0].find_last_of('/') + 1);
  for (const std::string& f : files)
    while (!f.starts_with(common)) common.erase(common.find_last_of('/', common.size() - 2) + 1);
  if (common.size() > 1) common.pop_back();
  return common.empty() ? "." : common;
}

/// One sentence for each kind of remark, naming the first file it was made of.
void addRemarks(const Entries& entries, std::vector<Warning>& warnings) {
  std::map<std::string, std::set<std::string>> filesByRemark;
  for (const Entry& e : entries)
    for (const std::string& remark : e.file->warnings) filesByRemark[remark].insert(e.file->path);
  for (const auto& [remark, files] : filesByRemark)
    warnings.emplace_back(
        fileName(*files.begin()) +
        (files.size() > 1 ? " and " + std::to_string(files.size() - 1) + " more files: " : ": ") + remark +
        ".");
}

/// Names the parts of concatenations that are not there.
void warnOfMissingParts(const Entries& entries, std::vector<Warning>& warnings) {
  std::map<std::string, std::set<int>> found;
  std::map<std::string, int> promised;
  for (const Entry& e : entries) {
    const Concatenation& c = e.file->concatenation;
    if (c.uid.empty() || c.part == 0) continue;
    found[c.uid].insert(c.part);
    promised[c.uid] = std::max(promised[c.uid], c.parts);
  }
  for (const auto& [uid, parts] : found)
    if (int(parts.size()) < promised[uid])
      warnings.emplace_back("Only " + std::to_string(parts.size()) + " of the " +
                            std::to_string(promised[uid]) + " parts of this concatenation are here.");
}

/// What all slices say alike; else empty.
std::string common(const Entries& entries, std::string Slice::*what) {
  const std::string& first = entries[0].slice().*what;
  const bool alike =
      std::all_of(entries.begin(), entries.end(), [&](const Entry& e) { return e.slice().*what == first; });
  return alike ? first : std::string();
}

Series describe(const Part& part) {
  const FileHeader& first = *part.entries[0].file;
  Series s;
  s.id = first.seriesUid.empty() ? fileName(first.path) : first.seriesUid;
  s.format = "DICOM";
  static_cast<SeriesIdentity&>(s) = first;
  s.unit = first.unit;
  s.time = first.time;
  s.echoTime = common(part.entries, &Slice::echoTime);
  s.bValue = common(part.entries, &Slice::bValue);
  s.timePoint = common(part.entries, &Slice::timePoint);
  if (s.timePoint.empty()) s.timePoint = part.name.timePoint;
  s.label = part.name.label;
  std::vector<const FileHeader*> headers;
  for (const Entry& e : part.entries) {
    s.files.push_back(e.file->path);
    s.frames.push_back(e.slice().frame);
    s.sopInstanceUids.push_back(e.file->sopInstanceUid);
    headers.push_back(e.file);
  }
  s.path = commonFolder(s.files);
  const std::vector<PlacedSlice> slices = placedSlices(part.entries);
  const Stack stack = layOut(slices, first.format.columns, first.format.rows);
  s.acquired = stack.acquired;
  s.regular = stack.regular;
  constexpr const char* names[] = {"uint8", "int16", "uint16", "float32"};
  s.valueType = names[planValues(headers, slices).type.index()];
  addSentences(s.warnings, part.warnings);
  s.warnings.insert(s.warnings.end(), stack.warnings.begin(), stack.warnings.end());
  addRemarks(part.entries, s.warnings);
  warnOfMissingParts(part.entries, s.warnings);
  return s;
}

/// The narrowest type for the integers of a file; float for all else.
VoxelValues typeOf(const PixelFormat& format) {
  if (format.kind != PixelFormat::Kind::integer || format.bitsAllocated > 16) return std::vector<float>{};
  if (format.isSigned) return std::vector<std::int16_t>{};
  if (format.bitsAllocated <= 8) return std::vector<std::uint8_t>{};
  return std::vector<std::uint16_t>{};
}

}  // namespace

std::vector<Series> sortIntoSeries(const std::vector<FileHeader>& files) {
  std::vector<Series> all;
  for (Entries& group : groups(files)) {
    order(group);
    const std::vector<std::string> copies = dropCopies(group);
    for (const Split& split : splitRepeats(group)) {
      for (Part& part : splitGaps(split.entries)) {
        part.name = split.name;
        part.warnings.insert(part.warnings.begin(), copies.begin(), copies.end());
        all.push_back(describe(part));
      }
    }
  }
  return all;
}

ValuePlan planValues(const std::vector<const FileHeader*>& files, std::span<const PlacedSlice> slices) {
  constexpr std::size_t u8 = 0, floats = 3;
  ValuePlan plan{typeOf(files[0]->format), false};
  for (std::size_t n = 0; n < slices.size(); ++n) {
    const Slice& slice = slices[n].slice;
    const VoxelValues type = typeOf(files[n]->format);
    const bool isOther = slice.slope != slices[0].slice.slope || slice.intercept != slices[0].slice.intercept;
    // Windows of mapped values are no LINEAR ones, as those of integers are (slices.md 3).
    if (isOther || (slice.isMapped && slice.slope != 1))
      plan.type = std::vector<float>{};
    else if (plan.type.index() == u8)
      plan.type = type;
    else if (type.index() != plan.type.index() && type.index() != u8)
      plan.type = std::vector<float>{};
  }
  plan.rescaled = plan.type.index() == floats;
  return plan;
}

}  // namespace volumen::dicom
