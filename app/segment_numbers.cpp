#include "app/segment_numbers.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/progress.h"
#include "io/export/read_segments.h"
#include "results/numbers/segment_columns.h"
#include "results/numbers/segments_over_time.h"
#include "results/numbers/series_columns.h"

namespace volumen {

namespace {

// Returns nothing if the series has one time point.
std::optional<SegmentsOverTime> overTimeOf(std::span<const Segmented> maps, const Opened& opened,
                                           PetUnit unit, const CancelToken& cancel) {
  if (opened.timePoints.empty()) return {};
  std::vector<const Series*> known;
  for (const Series& step : opened.timePoints) known.push_back(&step);
  TimeSteps steps = timeStepsOf(known, unit);
  for (TimeStep& step : steps.all)
    if (step.series.id == opened.series.id) step.volume = opened.loaded.drawn;
  std::vector<SegmentMap> measured;
  for (const Segmented& map : maps)
    measured.push_back({{}, map.segments, std::make_shared<const LabelMap>(map.labels), {}});
  SegmentsOverTime values =
      segmentsIn(steps, measured, valueScale(opened.series, unit).unit, terminalProgress(), cancel);
  endTerminalProgress();
  return values;
}

}  // namespace

Result<SegmentsFile> segmentsOfFile(const std::string& file, Opened& opened, const CancelToken& cancel) {
  auto read = readSegments(file, opened.series, opened.loaded.drawn->geometry(), {}, cancel,
                           acquiredSlicesOf(opened.loaded));
  if (read) opened.notes.insert(opened.notes.end(), read->notes.begin(), read->notes.end());
  return read;
}

Result<SegmentNumbersTold> numbersTold(std::span<const Segmented> maps, const Opened& opened, PetUnit unit,
                                       NumbersWanted wanted, const CancelToken& cancel) {
  SegmentNumbersTold all{{}, valueScale(opened.series, unit)};
  all.ofSeries = seriesFields(opened.series, timePointOf(opened.series));
  for (std::size_t n = 0; n < maps.size(); ++n) {
    const Volume& volume = *opened.loaded.drawn;
    auto reports = wanted.surfaces ? segmentReports(maps[n].segments, maps[n].labels, volume,
                                                    hasPeaks(opened.series.modality), cancel)
                                   : voxelReports(maps[n].segments, maps[n].labels, volume, cancel);
    if (!reports) return reports.error();
    for (SegmentReport& report : *reports) report.map = int(n);
    std::ranges::move(*reports, std::back_inserter(all.reports));
  }
  if (wanted.overTime) all.overTime = overTimeOf(maps, opened, unit, cancel);
  if (cancel.cancelled()) return Error{"Cancelled."};  // numbers are incomplete
  return all;
}

void addSegments(nlohmann::ordered_json& all, const SegmentNumbersTold& numbers) {
  all["of"] = identityJson(numbers.ofSeries);
  all["segments"] = segmentsJson(numbers.reports, numbers.scale.factor);
  for (auto& segment : all["segments"]) segment["unit"] = numbers.scale.unit;
  all["unit"] = numbers.scale.unit;
  if (!numbers.scale.why.empty()) all["noSuv"] = numbers.scale.why;
  if (numbers.overTime) addTimePoints(all, *numbers.overTime);
}

void addSegmentNotes(Opened& opened, std::span<const SegmentReport> reports) {
  if (!opened.loaded.drawn->geometry().calibrated)
    opened.notes.push_back("Not calibrated: segments have no lengths, areas and volumes.");
  for (const SegmentReport& report : reports)
    if (report.voxels == 0) opened.notes.push_back(report.segment.label + ": no voxel is in it.");
}

Result<std::optional<OutputFile>> writeCsv(const std::string& path, const SegmentNumbersTold& numbers) {
  if (path.empty()) return std::optional<OutputFile>();
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  if (Status s = file->write(segmentsAsCsv(numbers.reports, numbers.scale, numbers.ofSeries).toStdString());
      !s)
    return s.error();
  return std::optional(std::move(*file));
}

}  // namespace volumen
