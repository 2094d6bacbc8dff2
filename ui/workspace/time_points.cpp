#include "ui/workspace/time_points.h"

#include <algorithm>

#include "ui/workspace/flat_plane.h"

namespace volumen {

std::vector<const Series*> timePointsOf(const Workspace& workspace, const SeriesKey& series) {
  const auto shown = workspace.series.find(series);
  if (shown == workspace.series.end()) return {};
  std::vector<const Series*> steps;
  for (const auto& [key, state] : workspace.series)
    if (areTimePoints(*shown->second.series, *state.series)) steps.push_back(state.series.get());
  sortTimePoints(steps);
  return steps;
}

QString timePointText(const Workspace& workspace, const SeriesKey& series) {
  const std::vector<const Series*> steps = timePointsOf(workspace, series);
  return steps.empty() ? QString() : timePointText(steps, *workspace.series.at(series).series);
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
