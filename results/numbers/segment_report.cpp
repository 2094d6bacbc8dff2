#include "results/numbers/segment_report.h"

#include <new>
#include <nlohmann/json.hpp>

#include "results/numbers/code_json.h"
#include "results/numbers/csv.h"
#include "results/numbers/segment_columns.h"
#include "results/numbers/series_columns.h"
#include "results/segments/segment_record.h"
#include "viewer/measure/peak.h"

namespace volumen {

namespace {

using Json = nlohmann::ordered_json;

const Error noMemory{"There is not enough memory to measure the segments."};

Json knownNumber(const std::optional<double>& number) { return number ? Json(*number) : Json(); }

// Writes voxel counts and indices as integers.
Json numberJson(double number, bool isWhole) { return isWhole ? Json(std::int64_t(number)) : Json(number); }

Json columnJson(const SegmentColumn& column, const std::vector<double>& numbers) {
  if (numbers.empty()) return {};
  const bool isWhole = column.unit == SegmentColumn::Unit::voxels;
  if (column.parts.empty()) return numberJson(numbers.front(), isWhole);
  Json list = Json::array();
  for (const double number : numbers) list.push_back(numberJson(number, isWhole));
  return list;
}

Json histogramJson(const ValueCounts& counts, double factor) {
  if (counts.counts.empty()) return {};
  return {{"from", counts.low * factor}, {"width", counts.width * factor}, {"counts", counts.counts}};
}

}  // namespace

Result<std::vector<SegmentReport>> voxelReports(std::span<const Segment> segments, const LabelMap& labels,
                                                const Volume& volume, const CancelToken& cancel) try {
  std::vector<SegmentReport> all;
  for (const Segment& segment : segments) {
    const BitMask mask = maskOf(labels, std::uint8_t(segment.number));
    SegmentReport report{segment, mask.count(), {}, valuesIn(mask, volume), {}, {}};
    const VoxelGeometry& grid = volume.geometry();
    if (grid.calibrated) report.millilitres = double(report.voxels) * grid.voxelVolume() / 1000;
    auto form = voxelFormOf(mask, cancel);
    if (!form) return form.error();
    report.form = *form;
    report.made = madeText(segment);
    if (cancel.cancelled()) return Error{"Cancelled."};
    all.push_back(std::move(report));
  }
  return all;
} catch (const std::bad_alloc&) {
  return noMemory;
}

Status addSurfaces(std::span<SegmentReport> reports, const LabelMap& labels, const Volume& volume,
                   bool withPeaks, const CancelToken& cancel, const SegmentProgress& progress) try {
  std::size_t done = 0;
  for (SegmentReport& report : reports) {
    if (progress) progress(report.segment, done++);
    const BitMask mask = maskOf(labels, std::uint8_t(report.segment.number));
    auto form = formOf(mask, cancel);
    if (!form) return form.error();
    report.form = *form;
    if (withPeaks)
      if (const auto peak = peakAbout(voxelsOf(mask), volume, cancel)) report.peak = peak->mean;
    if (cancel.cancelled()) return Error{"Cancelled."};
  }
  return {};
} catch (const std::bad_alloc&) {
  return noMemory;
}

Result<std::vector<SegmentReport>> segmentReports(std::span<const Segment> segments, const LabelMap& labels,
                                                  const Volume& volume, bool withPeaks,
                                                  const CancelToken& cancel,
                                                  const SegmentProgress& progress) {
  auto all = voxelReports(segments, labels, volume, cancel);
  if (!all) return all;
  if (const Status s = addSurfaces(*all, labels, volume, withPeaks, cancel, progress); !s) return s.error();
  return all;
}

namespace {

// Returns kind and numbers of a step, without positions and names of other steps.
std::string stepText(const Step& step) {
  std::string fields;
  for (const auto& [name, value] : step.fields) {
    const auto* number = std::get_if<double>(&value);
    if (!number) continue;
    fields += ' ' + name + ' ' + csvNumber(*number).toStdString();
  }
  return step.kind + fields;
}

}  // namespace

std::string madeText(const Segment& segment, std::span<const Step> steps) {
  std::string text;
  const auto add = [&](const std::string& what) {
    if (!what.empty()) text += (text.empty() ? "" : "; ") + what;
  };
  for (const Step& step : steps)
    if (step.segment == stepNameOf(segment.number)) add(stepText(step));
  if (!text.empty()) return text;
  add(segment.description);
  if (segment.range)
    add(stepText({"range", {}, {{"low", segment.range->low}, {"high", segment.range->high}}}));
  add(segment.algorithm);
  return text;
}

bool hasPeaks(const std::string& modality) { return modality == "PT" || modality == "NM"; }

Json identityJson(const QStringList& fields) {
  Json json = Json::object();
  for (qsizetype n = 0; n < fields.size(); ++n)
    json[seriesColumns()[std::size_t(n)].key] = fields[n].toStdString();
  return json;
}

Json segmentsJson(std::span<const SegmentReport> all, double factor) {
  Json list = Json::array();
  for (const SegmentReport& report : all) {
    Json json{{"map", report.map + 1},
              {"number", report.segment.number},
              {"name", report.segment.label},
              {"category", codeJson(report.segment.category)},
              {"type", codeJson(report.segment.type)}};
    for (const SegmentColumn& column : segmentColumns())
      json[column.key] = columnJson(column, segmentNumbers(column, report, factor));
    json["histogram"] = histogramJson(report.values.histogram, factor);
    list.push_back(std::move(json));
  }
  return list;
}

Json likenessJson(const SegmentLikeness& alike) {
  const auto& distances = alike.distances;
  return {{"dice", knownNumber(alike.dice)},
          {"differenceMl", knownNumber(alike.differenceMl)},
          {"hausdorffMm", distances ? Json(distances->largest) : Json()},
          {"hausdorff95Mm", distances ? Json(distances->p95) : Json()},
          {"meanDistanceMm", distances ? Json(distances->mean) : Json()}};
}

}  // namespace volumen
