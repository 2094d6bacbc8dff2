#include "io/dicom/series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "io/dicom/copies.h"
#include "io/dicom/identity.h"
#include "io/dicom/lines.h"
#include "io/dicom/split.h"
#include "io/regular_file.h"

namespace volumen::dicom {
namespace {

bool near(glm::dvec3 a, glm::dvec3 b, double tolerance) { return glm::length(a - b) <= tolerance; }

/// Returns whether a slice of a CT lacks the attributes that give its unit. It may belong to slices that have
/// them.
bool lacksRescale(const Entry& e) {
  return e.file->modality == "CT" && e.file->unit.empty() && !e.slice().isRescaled && !e.slice().isMapped;
}

/// Returns whether two pictures can be slices of one volume, apart from their positions.
bool fit(const Entry& a, const Entry& b) {
  const Slice &s = a.slice(), &t = b.slice();
  if (a.file->format.columns != b.file->format.columns || a.file->format.rows != b.file->format.rows)
    return false;
  if (a.file->unit != b.file->unit && !lacksRescale(a) && !lacksRescale(b)) return false;
  if (isPlaced(s) != isPlaced(t)) return false;
  if (!isPlaced(s)) return true;
  // Orientations have about six digits; 1e-3 is 0.25 mm at the edge of a 500 mm picture.
  return near(s.orientation->row, t.orientation->row, 1e-3) &&
         near(s.orientation->column, t.orientation->column, 1e-3) &&
         glm::length(*s.spacing - *t.spacing) <= 1e-3 * glm::length(*s.spacing);
}

/// Returns whether a picture is a localizer, not a slice of a stack (PS3.3 C.8.2.1.1.1).
bool isLocalizer(const Entry& e) {
  static const std::size_t imageType = separatorAt("ImageType");
  const std::string& type = e.slice().separators[imageType];
  const std::size_t third = type.find('\\', type.find('\\') + 1) + 1;
  return third > 0 && type.substr(third, type.find('\\', third) - third) == "LOCALIZER";
}

/// Groups pictures that can be slices of one volume, apart from their positions.
std::vector<Entries> groups(const std::vector<const FileHeader*>& files) {
  std::vector<Entries> known;
  for (const FileHeader* file : files) {
    for (const Slice& slice : file->slices) {
      Entry entry{file, {SharedSlice::of(slice), file->path, 0}};
      // Only the last groups are tried, or a file of a hundred thousand directions would take minutes.
      const auto first = known.end() - std::min<std::ptrdiff_t>(256, known.end() - known.begin());
      const auto it = std::find_if(first, known.end(), [&](const Entries& g) {
        return isLocalizer(g[0]) == isLocalizer(entry) && fit(g[0], entry);
      });
      if (it == known.end())
        known.push_back({entry});
      else
        it->push_back(entry);
    }
  }
  return known;
}

/// Sorts along row x column if slices have positions, else by InstanceNumber and name.
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

/// A future volume: its slices, warnings and lost files.
struct Part {
  Entries entries;
  std::vector<Warning> warnings;
  std::vector<Unread> unread = {};
};

/// Splits at gaps of more than 4 usual distances, or more than 20 mm above the usual one (design.md 10).
std::vector<Part> splitGaps(const Entries& entries) {
  std::vector<Part> parts(1);
  if (!isPlaced(entries[0].slice()) || entries.size() < 3) return {{entries, {}}};
  const std::vector<double> steps = stepsMm(placedSlices(entries));
  const double median = lowerMedian(steps);
  for (std::size_t n = 0; n < entries.size(); ++n) {
    parts.back().entries.push_back(entries[n]);
    if (n == steps.size() || (steps[n] <= 4 * median && steps[n] <= median + 20)) continue;
    const std::string gap = "Gap of " + millimetres(steps[n]) + " mm between " +
                            fileName(entries[n].file->path) + " and " + fileName(entries[n + 1].file->path) +
                            ": the slices on either side are series of their own.";
    parts.back().warnings.emplace_back(gap);
    parts.push_back({{}, {Warning(gap)}});
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

/// Adds one sentence for each kind of remark, with the name of its first file.
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

/// Warns of missing parts of concatenations.
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

/// Returns the value that all slices share, else empty.
std::string common(const Entries& entries, std::string Slice::*what) {
  const std::string& first = entries[0].slice().*what;
  const bool alike =
      std::all_of(entries.begin(), entries.end(), [&](const Entry& e) { return e.slice().*what == first; });
  return alike ? first : std::string();
}

/// Returns the thickness of all slices; 0 if they differ.
double commonThickness(const Entries& entries) {
  const double first = entries[0].slice().thickness;
  const bool alike =
      std::ranges::all_of(entries, [&](const Entry& e) { return e.slice().thickness == first; });
  return alike ? first : 0;
}

/// Returns the view of each entry, for Series::projections.
std::vector<ProjectionView> projectionsOf(const Entries& entries) {
  std::vector<ProjectionView> all;
  for (const Entry& e : entries) all.push_back({e.file->laterality, e.file->viewPosition});
  return all;
}

Series describe(const Part& part, const Split& split) {
  const FileHeader& first = *part.entries[0].file;
  Series s;
  s.id = first.seriesUid.empty() ? fileName(first.path) : first.seriesUid;
  s.format = "DICOM";
  static_cast<SeriesIdentity&>(s) = first;
  s.unit = common(part.entries, &Slice::unit);
  s.time = first.time;
  s.echoTime = common(part.entries, &Slice::echoTime);
  s.bValue = common(part.entries, &Slice::bValue);
  s.timePoint = common(part.entries, &Slice::timePoint);
  if (s.timePoint.empty()) s.timePoint = split.timePoint;
  s.label = split.label;
  s.splitBy = split.by;
  s.sliceThickness = commonThickness(part.entries);
  for (const Entry& e : part.entries) {
    if (!s.lossyRatio) s.lossyRatio = e.file->lossyRatio;
    if (s.contrastAgent.empty()) s.contrastAgent = e.file->contrastAgent;
  }
  std::vector<const FileHeader*> headers;
  for (const Entry& e : part.entries) {
    s.files.push_back(e.file->path);
    s.frames.push_back(e.slice().frame);
    s.sopInstanceUids.push_back(e.file->sopInstanceUid);
    s.orders.push_back({e.slice().instance, e.file->time});
    headers.push_back(e.file);
  }
  setProjections(s, projectionsOf(part.entries));
  s.path = commonFolder(s.files);
  const std::vector<PlacedSlice> slices = placedSlices(part.entries);
  const Stack stack = layOut(slices, first.format.columns, first.format.rows);
  s.acquired = stack.acquired;
  s.regular = stack.regular;
  constexpr const char* names[] = {"uint8", "int16", "uint16", "float32"};
  s.valueType = names[planValues(headers, slices).type.index()];
  s.warnings = part.warnings;
  s.unread = part.unread;
  if (!split.warning.empty()) s.warnings.emplace_back(split.warning, WarningKind::notSeparated);
  s.warnings.insert(s.warnings.end(), stack.warnings.begin(), stack.warnings.end());
  addRemarks(part.entries, s.warnings);
  warnOfMissingParts(part.entries, s.warnings);
  return s;
}

/// Pictures along one line, with warnings.
struct ToldStack {
  Entries entries;
  std::vector<Warning> warnings;
  bool areLocalizers = false;  ///< true beside slices of their grid
};

/// Adds the stacks of group `n` of `groups`.
void addStacks(std::size_t n, std::vector<Entries>& groups, const std::vector<Warning>& told,
               std::vector<ToldStack>& stacks) {
  Entries& group = groups[n];
  const bool areLocalizers = isLocalizer(group[0]) && std::ranges::any_of(groups, [&](const Entries& other) {
                               return !isLocalizer(other[0]) && fit(other[0], group[0]);
                             });
  order(group);
  std::vector<Warning> warnings = told;
  addSentences(warnings, dropCopies(group));
  double apartMm = 0;
  std::vector<Entries> lines = byLine(group, apartMm);
  if (lines.size() > 1)
    warnings.emplace_back("Its slices lie along " + std::to_string(lines.size()) + " lines, up to " +
                          millimetres(apartMm) + " mm beside each other: each is a volume of its own.");
  for (Entries& line : lines) stacks.push_back({std::move(line), warnings, areLocalizers});
}

/// Returns z, y, x of the first slice, mm; 0 without position.
std::array<double, 3> firstPlace(const ToldStack& stack) {
  const glm::dvec3 p = stack.entries[0].slice().position.value_or(glm::dvec3(0));
  return {p.z, p.y, p.x};
}

void addFrames(const Split& split, Sorted& all) {
  for (const Entry& e : split.entries)
    if (std::ranges::find(all.frames, e.file) == all.frames.end()) all.frames.push_back(e.file);
}

/// Removes slices without rescale if others have one that matters, as the meaning of their values is unknown.
std::vector<Unread> withoutRescale(Entries& entries) {
  std::vector<Unread> unread;
  const bool matters = std::ranges::any_of(entries, [](const Entry& e) {
    return e.slice().isRescaled && (e.slice().slope != 1 || e.slice().intercept != 0);
  });
  if (!matters) return unread;
  std::erase_if(entries, [&](const Entry& e) {
    if (e.slice().isRescaled || e.slice().isMapped) return false;
    unread.push_back({{e.file->path,
                       "it gives no rescale (RescaleSlope), as the other slices do: what its values are is "
                       "not known."},
                      false,
                      e.slice().position});
    return true;
  });
  return unread;
}

void addVolumes(const ToldStack& stack, Sorted& all) {
  static const Separator& imageType = separators()[separatorAt("ImageType")];
  for (Split& split : splitRepeats(stack.entries)) {
    if (stack.areLocalizers) addName(split, imageType, "LOCALIZER", "LOCALIZER");
    if (split.isGuess) {
      addFrames(split, all);
      continue;
    }
    Entries entries = split.entries;
    const std::vector<Unread> unread = withoutRescale(entries);
    for (Part& part : splitGaps(entries)) {
      part.unread = unread;
      part.warnings.insert(part.warnings.begin(), stack.warnings.begin(), stack.warnings.end());
      all.volumes.push_back(describe(part, split));
    }
  }
}

/// Returns the narrowest type for the integers of a file; float for all else.
VoxelValues typeOf(const PixelFormat& format) {
  if (format.kind != PixelFormat::Kind::integer || format.bitsAllocated > 16) return std::vector<float>{};
  if (format.isSigned) return std::vector<std::int16_t>{};
  if (format.bitsAllocated <= 8) return std::vector<std::uint8_t>{};
  return std::vector<std::uint16_t>{};
}

}  // namespace

Sorted sortIntoSeries(const std::vector<FileHeader>& files) {
  Sorted sorted;
  for (const SameIdentity& same : byIdentity(files)) {
    std::vector<ToldStack> stacks;
    std::vector<Entries> all = groups(same.files);
    for (std::size_t n = 0; n < all.size(); ++n) addStacks(n, all, same.warnings, stacks);
    std::ranges::stable_sort(stacks, {}, firstPlace);
    for (const ToldStack& stack : stacks) addVolumes(stack, sorted);
  }
  return sorted;
}

ValuePlan planValues(const std::vector<const FileHeader*>& files, std::span<const PlacedSlice> slices) {
  constexpr std::size_t u8 = 0, floats = 3;
  ValuePlan plan{typeOf(files[0]->format), false};
  for (std::size_t n = 0; n < slices.size(); ++n) {
    const Slice& slice = slices[n].slice;
    const VoxelValues type = typeOf(files[n]->format);
    const bool isOther =
        slice.slope != slices[0].slice->slope || slice.intercept != slices[0].slice->intercept;
    // Windows on mapped values are not LINEAR ones, unlike those on integers (slices.md 3).
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
