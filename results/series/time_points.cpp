#include "results/series/time_points.h"

#include <QStringList>
#include <algorithm>
#include <charconv>
#include <glm/geometric.hpp>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "results/series/series_facts.h"
#include "results/text/series_text.h"
#include "results/text/text.h"

namespace volumen {

namespace {

using Steps = std::vector<const Series*>;
using Named = std::string Series::*;

// Attributes by which time points differ. The first that varies names them.
constexpr Named namedBy[] = {&Series::bValue, &Series::echoTime, &Series::timePoint, &Series::label};

std::set<std::string> valuesOf(const Steps& steps, Named by) {
  std::set<std::string> values;
  for (const Series* step : steps) values.insert(step->*by);
  return values;
}

// Only some may have labels: an image without diffusion weighting has no direction.
bool varies(const Steps& steps, Named by) {
  const std::set<std::string> values = valuesOf(steps, by);
  return values.size() > 1 && (by == &Series::label || !values.contains({}));
}

bool tellsAll(const Steps& steps, Named by) {
  const std::set<std::string> values = valuesOf(steps, by);
  return values.size() == steps.size() && !values.contains({});
}

// Returns null if no attribute varies.
const Named* firstVarying(const Steps& steps) {
  const auto found = std::ranges::find_if(namedBy, [&](Named a) { return varies(steps, a); });
  return found == std::end(namedBy) ? nullptr : found;
}

// Returns the number that a text begins with.
std::optional<double> numberOf(const std::string& text) {
  double number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  return read.ec == std::errc() ? std::optional(number) : std::nullopt;
}

// Returns the seconds since midnight of "HHMMSS.FFFFFF".
std::optional<double> secondsOf(const std::string& time) {
  if (time.size() < 6 ||
      !std::all_of(time.begin(), time.begin() + 6, [](char c) { return c >= '0' && c <= '9'; }))
    return {};
  return 3600 * *numberOf(time.substr(0, 2)) + 60 * *numberOf(time.substr(2, 2)) + *numberOf(time.substr(4));
}

// Returns the numbers; empty if some have none or they do not rise.
std::optional<std::vector<double>> risingNumbers(const Steps& steps, Named by) {
  std::vector<double> numbers;
  for (const Series* step : steps) {
    const auto number = by == &Series::time ? secondsOf(step->time) : numberOf(step->*by);
    if (!number || (!numbers.empty() && *number <= numbers.back())) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

bool allAreCalled(const Steps& steps, const char* noun) {
  return std::ranges::all_of(steps, [&](const Series* s) { return s->label.starts_with(noun); });
}

// Returns the number after the "#" in an id "NAME#3"; 0 if there is none.
double volumeNumber(const Series& series) {
  const std::size_t mark = series.id.find_last_of('#');
  return mark == std::string::npos ? 0 : numberOf(series.id.substr(mark + 1)).value_or(0);
}

bool onOneGrid(const VoxelGeometry& a, const VoxelGeometry& b) {
  constexpr double within = 1e-3;  // mm
  if (a.size != b.size || glm::length(a.origin - b.origin) > within) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (glm::length(a.patientFromVoxelStep[axis] - b.patientFromVoxelStep[axis]) * a.size[axis] > within)
      return false;
  return true;
}

auto orderOf(const Series& series) {
  return std::tuple(numberOf(series.bValue).value_or(0), numberOf(series.echoTime).value_or(0),
                    numberOf(series.timePoint).value_or(0), volumeNumber(series),
                    std::string_view(series.id));
}

}  // namespace

bool areTimePoints(const Series& a, const Series& b) {
  if (!areOfOnePatient(a, b)) return false;
  if (a.id == b.id && a.path == b.path) return true;
  if (a.curved || b.curved) return false;
  if (!a.notVolume.empty() || !b.notVolume.empty() || a.format != b.format || a.path != b.path ||
      a.seriesUid != b.seriesUid || a.studyUid != b.studyUid || !onOneGrid(a.acquired, b.acquired))
    return false;
  if (a.format == "DICOM")
    return !a.seriesUid.empty() && std::ranges::any_of(namedBy, [&](Named by) { return a.*by != b.*by; });
  return volumeNumber(a) > 0 && volumeNumber(b) > 0;
}

void sortTimePoints(std::vector<const Series*>& steps) {
  std::vector<std::pair<decltype(orderOf(*steps[0])), const Series*>> ordered;
  for (const Series* step : steps) ordered.emplace_back(orderOf(*step), step);
  std::ranges::sort(ordered);
  std::ranges::transform(ordered, steps.begin(), [](const auto& step) { return step.second; });
}

QString stepsText(const std::vector<const Series*>& steps) {
  if (steps.size() < 2) return {};
  const QString text = tellsAll(steps, &Series::bValue)      ? tr("%1 b-values")
                       : tellsAll(steps, &Series::echoTime)  ? tr("%1 echoes")
                       : tellsAll(steps, &Series::timePoint) ? tr("%1 time points")
                       : allAreCalled(steps, "direction")    ? tr("%1 directions")
                       : allAreCalled(steps, "component")    ? tr("%1 components")
                                                             : tr("%1 volumes");
  return text.arg(steps.size());
}

Series commonOf(const std::vector<const Series*>& steps) {
  Series common = *steps.front();
  for (const Named by :
       {&Series::bValue, &Series::echoTime, &Series::timePoint, &Series::label, &Series::time})
    if (valuesOf(steps, by).size() > 1) (common.*by).clear();
  std::erase_if(common.warnings, [&](const Warning& warning) {
    return !std::ranges::all_of(steps, [&](const Series* step) {
      return std::ranges::find(step->warnings, warning) != step->warnings.end();
    });
  });
  return common;
}

QString timePointText(const Steps& steps, const Series& step) {
  const QString label = shownText(step.label);
  if (steps.size() < 2) return label;
  const QString number =
      tr("%1 of %2").arg(std::ranges::find(steps, &step) - steps.begin() + 1).arg(steps.size());
  const Named* varying = firstVarying(steps);
  if (varying && !tellsAll(steps, *varying))
    if (const QStringList parts = tellingApart(step, steps); !parts.isEmpty())
      return tr("%1 (%2)").arg(parts.join(QStringLiteral(", ")), number);
  if (!varying || (*varying == &Series::label && (label.isEmpty() || label == number)))
    return tr("volume %1").arg(number);
  const QString value = shownText(step.*(*varying));
  if (*varying == &Series::bValue) return tr("b %1 (%2)").arg(value, number);
  if (*varying == &Series::echoTime && varies(steps, &Series::label) && !label.isEmpty())
    return tr("TE %1 ms, %2 (%3)").arg(value, label, number);
  if (*varying == &Series::echoTime) return tr("echo %1: %2 ms").arg(number, value);
  if (*varying == &Series::label) return tr("%1 (%2)").arg(label, number);
  return tr("time point %1").arg(number);
}

QString timeAxisText(const std::vector<const Series*>& steps) {
  const Named* varying = firstVarying(steps);
  if (!varying) return {};
  constexpr int most = 20;
  QStringList values;
  for (const Series* step : steps) values << shownText(step->*(*varying));
  values.removeDuplicates();
  if (values.size() > most || *varying == &Series::label) return stepsText(steps);
  const QString all = values.join(QStringLiteral(", "));
  if (*varying == &Series::bValue) return tr("b = %1").arg(all);
  return *varying == &Series::echoTime ? tr("echo times %1 ms").arg(all) : tr("time points %1").arg(all);
}

StepAxis stepAxisOf(const std::vector<const Series*>& steps) {
  if (const auto b = risingNumbers(steps, &Series::bValue)) return {tr("b (s/mm\u00b2)"), *b};
  if (const auto echo = risingNumbers(steps, &Series::echoTime)) return {tr("Echo time (ms)"), *echo};
  if (auto time = risingNumbers(steps, &Series::time)) {
    const double first = time->empty() ? 0 : time->front();
    for (double& seconds : *time) seconds -= first;
    return {tr("Time (s)"), *time};
  }
  StepAxis numbers{tr("Volume"), {}};
  for (std::size_t n = 1; n <= steps.size(); ++n) numbers.at.push_back(double(n));
  return numbers;
}

}  // namespace volumen
