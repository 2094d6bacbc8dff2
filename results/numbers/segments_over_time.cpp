#include "results/numbers/segments_over_time.h"

#include <nlohmann/json.hpp>

#include "results/numbers/segment_charts.h"
#include "results/text/text.h"
#include "viewer/segment/numbers.h"

namespace volumen {

namespace {

// Returns nothing if the volume is null or of another size.
std::optional<StepValues> valuesOfStep(const VolumePtr& volume, const BitMask& mask, double factor) {
  if (!volume || volume->size() != mask.size()) return {};
  const SegmentValues values = valuesIn(mask, *volume);
  if (values.voxels == 0) return {};
  return StepValues{values.mean * factor, values.sd * factor, values.min * factor, values.max * factor};
}

}  // namespace

SegmentsOverTime segmentsIn(const TimeSteps& steps, const std::vector<SegmentMap>& maps,
                            const std::string& unit, const Progress& progress, const CancelToken& cancel) {
  SegmentsOverTime found{steps.axis, unit, {}};
  for (const SegmentMap& map : maps) found.segments.resize(found.segments.size() + map.segments.size());
  for (std::size_t n = 0; n < steps.all.size(); ++n) {
    if (cancel.cancelled()) break;
    if (progress) progress("measuring time points", n, steps.all.size());
    const std::optional<double> factor = factorTo(unit, steps.all[n]);
    const VolumePtr volume = factor ? volumeOf(steps.all[n], progress, cancel) : nullptr;
    std::size_t segment = 0;
    for (const SegmentMap& map : maps)
      for (const Segment& each : map.segments)
        found.segments[segment++].push_back(
            valuesOfStep(volume, maskOf(*map.labels, std::uint8_t(each.number)), factor.value_or(1)));
  }
  return found;
}

MeasuredChart segmentsOverTimeChart(const SegmentsOverTime& values, std::span<const SegmentReport> all,
                                    std::span<const std::size_t> chosen) {
  MeasuredChart chart = timeChart(values.axis, {}, values.unit);
  for (const std::size_t n : chosen) {
    std::vector<std::optional<double>> means;
    std::vector<double> sds;
    for (const std::optional<StepValues>& step : values.segments[n]) {
      means.push_back(step ? std::optional(step->mean) : std::nullopt);
      if (step) sds.push_back(step->sd);
    }
    MeasuredChart one = timeChart(values.axis, means, values.unit);
    const ChartLineLook look = lookOf(all[n].segment);
    if (!one.problem.isEmpty()) chart.problem = tr("%1: %2").arg(look.name, one.problem);
    if (one.lines.empty()) continue;
    chart.lines.push_back(std::move(one.lines.front()));
    chart.sds.push_back(std::move(sds));
    chart.looks.push_back(look);
  }
  return chart;
}

nlohmann::ordered_json timePointsJson(const SegmentsOverTime& values, std::size_t segment) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (std::size_t n = 0; n < values.segments[segment].size(); ++n) {
    const std::optional<StepValues>& step = values.segments[segment][n];
    const auto number = [&](double StepValues::*which) { return step ? Json((*step).*which) : Json(); };
    list.push_back({{"at", values.axis.at[n]},
                    {"mean", number(&StepValues::mean)},
                    {"sd", number(&StepValues::sd)},
                    {"min", number(&StepValues::min)},
                    {"max", number(&StepValues::max)}});
  }
  return list;
}

void addTimePoints(nlohmann::ordered_json& numbers, const SegmentsOverTime& values) {
  numbers["timeAxis"] = values.axis.title.toStdString();
  for (std::size_t n = 0; n < values.segments.size(); ++n)
    numbers["segments"][n]["timePoints"] = timePointsJson(values, n);
}

}  // namespace volumen
