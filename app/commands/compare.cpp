#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/open_volume.h"
#include "app/segment_text.h"
#include "app/usage.h"
#include "io/export/read_segments.h"

namespace volumen {

namespace {

struct CompareOptions {
  std::string first, second;
  bool json = false;
};

// A segment of a file, and the label map that contains it.
struct SegmentIn {
  const Segment* segment;
  const LabelMap* labels;
  BitMask mask() const { return maskOf(*labels, std::uint8_t(segment->number)); }
};

std::vector<SegmentIn> segmentsIn(const SegmentsFile& file) {
  std::vector<SegmentIn> all;
  for (const Segmented& map : file.maps)
    for (const Segment& segment : map.segments) all.push_back({&segment, &map.labels});
  return all;
}

// Returns pairs of segments with equal names. If each file has one segment, it returns these, whatever their
// names.
std::vector<std::pair<SegmentIn, SegmentIn>> pairsOf(const std::vector<SegmentIn>& first,
                                                     const std::vector<SegmentIn>& second) {
  if (first.size() == 1 && second.size() == 1) return {{first[0], second[0]}};
  std::vector<std::pair<SegmentIn, SegmentIn>> pairs;
  for (const SegmentIn& a : first) {
    const auto b =
        std::ranges::find(second, a.segment->label, [](const SegmentIn& s) { return s.segment->label; });
    if (b != second.end()) pairs.push_back({a, *b});
  }
  return pairs;
}

Result<std::vector<ComparedSegments>> compared(const SegmentsFile& first, const SegmentsFile& second,
                                               const CancelToken& cancel) {
  std::vector<ComparedSegments> all;
  for (const auto& [a, b] : pairsOf(segmentsIn(first), segmentsIn(second))) {
    const Result<SegmentLikeness> alike = likeness(a.mask(), b.mask(), cancel);
    if (!alike) return alike.error();
    all.push_back({a.segment->label, b.segment->label, *alike});
  }
  if (all.empty()) return Error{"No segment of one file is called as one of the other."};
  return all;
}

void printCompared(const std::vector<ComparedSegments>& all, const std::vector<std::string>& notes) {
  nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
  for (const ComparedSegments& c : all) {
    nlohmann::ordered_json pair{{"first", c.first}, {"second", c.second}};
    pair.update(likenessJson(c.alike));
    pairs.push_back(std::move(pair));
  }
  std::cout << jsonText({{"pairs", pairs}, {"notes", notes}});
}

// Returns the segments of the second file on the grid of the first.
Result<SegmentsFile> secondOnFirst(const CompareOptions& options, const SegmentsFile& first,
                                   const CancelToken& cancel) {
  Result<SegmentsFile> second = readSegments(options.second, {}, cancel);
  if (!second) return second;
  if (!areOfOneSpace(first, *second))
    return Error{options.second + " is of another frame of reference than " + options.first +
                 ", and names none of its pictures: their places cannot be compared."};
  const std::size_t told = second->notes.size();
  second = onGrid(std::move(*second), first.maps.front().labels.geometry(), options.first);
  if (!second) return Error{options.second + ": " + second.message()};
  for (std::size_t n = told; n < second->notes.size(); ++n)
    second->notes[n] = options.second + ": " + second->notes[n];
  return second;
}

int run(const CompareOptions& options, const CancelToken& cancel) {
  const Result<SegmentsFile> first = readSegments(options.first, {}, cancel);
  if (!first) return fail(first.message(), cancel);
  const Result<SegmentsFile> second = secondOnFirst(options, *first, cancel);
  if (!second) return fail(second.message(), cancel);
  const auto all = compared(*first, *second, cancel);
  if (!all) return fail(all.message(), cancel);
  std::vector<std::string> notes = first->notes;
  notes.insert(notes.end(), second->notes.begin(), second->notes.end());
  if (!first->maps.front().labels.geometry().calibrated)
    notes.emplace_back("Not calibrated: no volumes and distances.");
  printNotes(notes);
  if (options.json)
    printCompared(*all, notes);
  else
    std::cout << comparedText(*all);
  return exitDone;
}

}  // namespace

std::function<int()> makeCompare(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<CompareOptions>();
  app.add_option("FIRST", options->first,
                 "Segments: a .seg.nrrd, a DICOM segmentation, or an image of labels")
      ->type_name("")
      ->required();
  app.add_option("SECOND", options->second, "Others, on the same grid or another one")
      ->type_name("")
      ->required();
  app.add_flag("--json", options->json, "Write one JSON object to stdout");
  addExamples(app, {"volumen compare first.seg.nrrd second.seg.nrrd",
                    "volumen compare first.seg.nrrd second.seg.nrrd --json"});
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
