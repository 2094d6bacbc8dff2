#include <charconv>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/command.h"
#include "app/open_volume.h"
#include "app/usage.h"
#include "io/export/seg_nrrd.h"
#include "io/files/output_file.h"
#include "viewer/segment/label_statistics.h"
#include "viewer/segment/mask.h"

namespace volumen {

namespace {

constexpr glm::u8vec3 boneIvory{240, 219, 163};

struct SegmentOptions {
  std::string path, range, output, series;
  bool json = false, removeTable = false;
};

// An end of the range: a number, or nothing for no end.
std::optional<double> readEnd(const std::string& text, double open) {
  if (text.empty()) return open;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

// "A:B", "A:" or ":B", A <= B.
std::optional<ValueRange> readRange(const std::string& text) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || text == ":") return {};
  const auto low = readEnd(text.substr(0, colon), -infinity),
             high = readEnd(text.substr(colon + 1), infinity);
  if (!low || !high || *low > *high) return {};
  return ValueRange{*low, *high};
}

void printText(const LabelStatistics& s, const std::string& unit, const std::string& output) {
  const std::string behind = unit.empty() ? "" : ' ' + printable(unit);
  std::cout << std::setprecision(10) << "voxels: " << s.voxels << '\n';
  if (s.millilitres) std::cout << "millilitres: " << *s.millilitres << '\n';
  for (const auto& [name, value] : {std::pair("mean", s.mean), {"min", s.min}, {"max", s.max}})
    if (s.voxels) std::cout << name << ": " << value << behind << '\n';
  std::cout << "file: " << printable(output) << '\n';
}

void printJson(const LabelStatistics& s, const Opened& opened, const ValueRange& range,
               const std::string& output) {
  const auto known = [](bool is, double value) { return is ? nlohmann::ordered_json(value) : nullptr; };
  const nlohmann::ordered_json all{
      {"series", opened.series.id},
      {"range", {known(std::isfinite(range.low), range.low), known(std::isfinite(range.high), range.high)}},
      {"voxels", s.voxels},
      {"millilitres", known(s.millilitres.has_value(), s.millilitres.value_or(0))},
      {"mean", known(s.voxels, s.mean)},
      {"min", known(s.voxels, s.min)},
      {"max", known(s.voxels, s.max)},
      {"unit", opened.series.unit},
      {"file", output},
      {"warnings", sentences(opened.loaded.warnings)},
      {"unread", unreadJson(opened.loaded.unread)}};
  std::cout << jsonText(all);
}

void addNotes(std::vector<std::string>& notes, const Opened& opened, const LabelStatistics& s,
              const std::string& range) {
  if (opened.loaded.drawn != opened.loaded.acquired)
    notes.push_back("The segment has the evenly spaced slices that are shown in 3D: " +
                    std::to_string(opened.loaded.drawn->size().z) + ".");
  if (!s.millilitres) notes.push_back("Not calibrated: no volume in millilitres.");
  if (!s.voxels) notes.push_back("No voxel has a value in " + range + "; the segment is empty.");
}

int run(const SegmentOptions& options, const CancelToken& cancel) {
  const auto range = readRange(options.range);
  if (!range)
    return failUsage("--range: \"" + options.range +
                     "\" is not LOW:HIGH, LOW: or :HIGH with LOW not above HIGH, as in 150:3000.");
  if (!options.output.ends_with(".seg.nrrd"))
    return failUsage(options.output + ": segmentations are written as .seg.nrrd.");
  if (auto file = OutputFile::create(options.output); !file) return fail(file.message());
  Result<Opened> opened = openVolume(options.path, options.series, cancel);
  if (!opened) return fail(opened.message(), cancel);
  const VolumePtr whole = opened->loaded.drawn;
  const Mask mask{options.removeTable, {}};
  if (options.removeTable)
    if (Status removed = takeAway(mask, *opened, cancel); !removed) return fail(removed.message(), cancel);
  const LabelMap map =
      withLabel(LabelMap(whole->geometry()), 1, keptVoxelsInRange(*whole, *range, mask, cancel));
  const Segment segment{.number = 1, .label = "Range " + options.range, .colour = boneIvory, .range = range};
  const LabelStatistics statistics = labelStatistics(map, *whole);
  if (const Status s = writeSegNrrd(map, {&segment, 1}, options.output, cancel); !s)
    return fail(s.message(), cancel);
  noteKeptTilt(*opened);
  addNotes(opened->notes, *opened, statistics, options.range);
  printNotes(opened->notes);
  if (options.json)
    printJson(statistics, *opened, *range, options.output);
  else
    printText(statistics, opened->series.unit, options.output);
  return opened->status();
}

}  // namespace

std::function<int()> makeSegment(CLI::App& app, const CancelToken& cancel) {
  auto options = std::make_shared<SegmentOptions>();
  addPath(app, options->path)->required();
  app.add_option("--range", options->range,
                 "Values to segment, both ends included: LOW:HIGH, LOW: or :HIGH (HU for CT)")
      ->type_name("LOW:HIGH")
      ->required();
  app.add_option("-o,--output", options->output, "The file to write, .seg.nrrd, as 3D Slicer reads it")
      ->type_name("FILE")
      ->required();
  addSeries(app, options->series);
  app.add_flag("--remove-table", options->removeTable,
               "CT: segment the patient alone, without table, cushions and cables");
  app.add_flag("--json", options->json, "Write one JSON object to stdout");
  addExamples(app, {"volumen segment scans/ --range 150:3000 -o bone.seg.nrrd",
                    "volumen segment scans/ --range :-300 --json -o air.seg.nrrd"});
  return [options, &cancel] { return run(*options, cancel); };
}

}  // namespace volumen
