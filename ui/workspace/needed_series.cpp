#include "ui/workspace/needed_series.h"

#include <algorithm>

#include "io/curved.h"
#include "ui/workspace/time_points.h"

namespace volumen {

namespace {

PoolKey withMask(const Workspace& workspace, const SeriesKey& series) {
  const auto known = workspace.series.find(series);
  return {series, known == workspace.series.end() ? Mask() : known->second.mask};
}

void add(std::vector<PoolKey>& wanted, const Workspace& workspace, const SeriesKey& series) {
  if (!series.empty() && std::ranges::find(wanted, series, &PoolKey::series) == wanted.end())
    wanted.push_back(withMask(workspace, series));
}

// A curved reformat is made from its source in memory.
void putSourcesFirst(std::vector<PoolKey>& wanted, const Workspace& workspace) {
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    const auto known = workspace.series.find(wanted[n].series);
    if (known == workspace.series.end() || !known->second.series->curved) continue;
    const auto source = std::find_if(
        wanted.begin() + std::ptrdiff_t(n), wanted.end(),
        [key = keyOf(sourceOf(*known->second.series))](const PoolKey& p) { return p.series == key; });
    if (source != wanted.end()) std::rotate(wanted.begin() + std::ptrdiff_t(n), source, source + 1);
  }
}

// Returns the neighbours of a time point: the next one first, which is the first one after the last.
std::vector<SeriesKey> neighboursOf(const Workspace& workspace, const SeriesKey& series) {
  const std::vector<const Series*> steps = timePointsOf(workspace, series);
  const auto at = std::ranges::find(steps, series, [](const Series* s) { return keyOf(*s); });
  if (steps.size() < 2 || at == steps.end()) return {};
  std::vector<SeriesKey> keys{keyOf(at + 1 == steps.end() ? *steps.front() : **(at + 1))};
  if (at != steps.begin() && keyOf(**(at - 1)) != keys.front()) keys.push_back(keyOf(**(at - 1)));
  return keys;
}

std::vector<SeriesKey> neededLater(const Workspace& workspace, const SeriesPool& inMemory) {
  const ViewState& view = workspace.view(workspace.focus);
  if (view.series.empty() || showsFrames(view.kind)) return {};
  const LoadedSeriesPtr shown = inMemory.peek(withMask(workspace, view.series));
  if (!shown) return {};
  std::vector<SeriesKey> keys = neighboursOf(workspace, view.series);
  // The time points of a series have one grid and size.
  while (!keys.empty() && !inMemory.hasRoomFor(keys.size() * shown->volume->bytes())) keys.pop_back();
  return keys;
}

}  // namespace

std::vector<PoolKey> seriesOnScreen(const Workspace& workspace) {
  std::vector<PoolKey> wanted;
  for (const ViewId id : focusFirst(workspace, viewsOnScreen(workspace))) {
    const ViewState& view = workspace.view(id);
    if (showsFrames(view.kind)) continue;
    add(wanted, workspace, view.series);
    if (!showsScene(view.kind)) add(wanted, workspace, flatLookOf(view).overlay);
  }
  putSourcesFirst(wanted, workspace);
  return wanted;
}

std::vector<NeededSeries> neededSeries(const Workspace& workspace, const Requests& requests,
                                       const SeriesPool& inMemory) {
  std::vector<NeededSeries> needed;
  if (requests.show) needed.push_back({requests.show->series, NeededFor::request});
  const auto add = [&](const PoolKey& key, NeededFor reason) {
    const auto known = workspace.series.find(key.series);
    if (known == workspace.series.end() || known->second.missing || requests.shows(key.series)) return;
    // A volume with a mask is made of the whole one.
    if (!inMemory.peek(key) && !inMemory.peek({key.series, {}}))
      needed.push_back({known->second.series, reason});
  };
  for (const PoolKey& key : seriesOnScreen(workspace)) add(key, NeededFor::screen);
  for (const SeriesKey& key : neededLater(workspace, inMemory)) add({key, {}}, NeededFor::later);
  return needed;
}

}  // namespace volumen
