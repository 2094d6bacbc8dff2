#include "ui/workspace/time_points.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>
#include <tuple>
#include <utility>

#include "ui/workspace/flat_plane.h"
#include "ui/workspace/patients.h"

namespace volumen {

namespace {

using Axis = std::string Series::*;
constexpr Axis axes[] = {&Series::bValue, &Series::echoTime, &Series::timePoint, &Series::label};

double numberIn(const std::string& text) {
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// Returns the number after the "#" in an id "NAME#3"; 0 if there is none.
double volumeNumber(const Series& series) {
  const std::size_t mark = series.id.find_last_of('#');
  return mark == std::string::npos ? 0 : numberIn(series.id.substr(mark + 1));
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
  return std::tuple(numberIn(series.bValue), numberIn(series.echoTime), numberIn(series.timePoint),
                    volumeNumber(series), std::string_view(series.id));
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
    return !a.seriesUid.empty() && std::ranges::any_of(axes, [&](Axis axis) { return a.*axis != b.*axis; });
  return volumeNumber(a) > 0 && volumeNumber(b) > 0;
}

void sortTimePoints(std::vector<const Series*>& steps) {
  std::vector<std::pair<decltype(orderOf(*steps[0])), const Series*>> ordered;
  for (const Series* step : steps) ordered.emplace_back(orderOf(*step), step);
  std::ranges::sort(ordered);
  std::ranges::transform(ordered, steps.begin(), [](const auto& step) { return step.second; });
}

std::vector<const Series*> timePointsOf(const Workspace& workspace, const SeriesKey& series) {
  const auto shown = workspace.series.find(series);
  if (shown == workspace.series.end()) return {};
  std::vector<const Series*> steps;
  for (const auto& [key, state] : workspace.series)
    if (areTimePoints(*shown->second.series, *state.series)) steps.push_back(state.series.get());
  sortTimePoints(steps);
  return steps;
}

bool hasTimePoints(const Workspace& workspace, const SeriesKey& series) {
  const auto shown = workspace.series.find(series);
  return shown != workspace.series.end() && std::ranges::any_of(workspace.series, [&](const auto& other) {
           return other.first != series && areTimePoints(*shown->second.series, *other.second.series);
         });
}

Workspace withTimePointsOf(Workspace workspace, const Series& series,
                           const std::vector<const Series*>& open) {
  for (const Series* other : open)
    if (areTimePoints(series, *other))
      if (!workspace.series.contains(keyOf(*other)))
        workspace.series.editOrAdd(keyOf(*other)).series = std::make_shared<const Series>(*other);
  return workspace;
}

Workspace withTimePoint(Workspace workspace, ViewId view, const SeriesKey& step) {
  const SeriesKey last = workspace.view(view).series;
  if (last == step || !workspace.series.contains(last) || !workspace.series.contains(step)) return workspace;
  const SeriesState from = workspace.series.at(last);
  SeriesState& to = workspace.series.edit(step);
  to.window = from.window;
  to.namedGrey = from.namedGrey;
  to.frameWindow = from.frameWindow;
  to.colours = from.colours;
  // Each volume without a frame of reference has its own.
  const std::string frame = frameOfReference(*from.series), next = frameOfReference(*to.series);
  const auto follow = [](auto& map, const auto& before, const auto& now) {
    const auto known = map.find(before);
    if (known == map.end() || before == now) return;
    const auto value = known->second;
    map.editOrAdd(now) = value;
  };
  follow(workspace.crosshairs, frame, next);
  const bool isOfGroup = view < firstComparedId;
  for (ViewId id = isOfGroup ? 0 : view; id <= (isOfGroup ? firstComparedId - 1 : view); ++id) {
    if (workspace.view(id).series != last) continue;
    ViewState& state = workspace.editView(id);
    follow(state.crosshairs, frame, next);
    follow(state.scenes, last, step);
    follow(state.flats, last, step);
    state.series = step;
  }
  return workspace;
}

}  // namespace volumen
