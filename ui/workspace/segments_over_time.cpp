#include "ui/workspace/segments_over_time.h"

#include <nlohmann/json.hpp>

#include "ui/workspace/segment_charts.h"
#include "ui/workspace/text.h"

namespace volumen {

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
