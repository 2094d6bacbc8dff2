#include "ui/workspace/curved_links.h"

#include <algorithm>
#include <glm/common.hpp>
#include <map>
#include <vector>

#include "io/curved.h"
#include "results/series/series_facts.h"
#include "ui/workspace/flat_plane.h"

namespace volumen {

namespace {

bool isMoved(const Workspace& before, const Workspace& after, const std::string& frame) {
  const auto now = after.crosshairs.find(frame);
  if (now == after.crosshairs.end()) return false;
  const auto was = before.crosshairs.find(frame);
  return was == before.crosshairs.end() || was->second.at != now->second.at;
}

// Returns the curved reformats on screen, by source series.
std::map<SeriesKey, std::vector<const Series*>> curvedOnScreen(const Workspace& workspace) {
  std::map<SeriesKey, std::vector<const Series*>> found;
  for (const ViewId id : viewsOnScreen(workspace)) {
    const Series* series = seriesIn(workspace, id);
    if (!series || !series->curved || workspace.series.at(keyOf(*series)).missing) continue;
    std::vector<const Series*>& all = found[keyOf(sourceOf(*series))];
    if (std::ranges::find(all, series) == all.end()) all.push_back(series);
  }
  return found;
}

// Returns the point nearest to `p` between the grid's outer voxel centres.
glm::dvec3 nearestIn(const VoxelGeometry& geometry, glm::dvec3 p) {
  const glm::dvec3 last(geometry.size - 1);
  return geometry.patientFromVoxel(glm::clamp(geometry.voxelFromPatient(p), glm::dvec3(0), last));
}

Result<CurvedGrid> gridOf(const Series& series) {
  return CurvedGrid::make(series.curved->recipe, drawnGeometry(sourceOf(series)));
}

}  // namespace

Workspace withCurvesFollowed(const Workspace& before, Workspace after) {
  if (!after.links.scroll) return after;
  const Workspace moved = after;
  for (const auto& [key, all] : curvedOnScreen(moved)) {
    const std::string frame = frameOfReference(sourceOf(*all.front()));
    const auto first = std::ranges::find_if(
        all, [&](const Series* series) { return isMoved(before, moved, frameOfReference(*series)); });
    if (first == all.end() && !isMoved(before, moved, frame)) continue;
    if (first != all.end()) {
      const Result<CurvedGrid> grid = gridOf(**first);
      if (!grid) continue;
      const glm::dvec3 at = moved.crosshairs.at(frameOfReference(**first)).at;
      after.crosshairs.editOrAdd(frame).at = grid->patientFromCurved(at);
    }
    const glm::dvec3 at = after.crosshairs.at(frame).at;
    for (const Series* series : all) {
      if (first != all.end() && series == *first) continue;
      if (const Result<CurvedGrid> grid = gridOf(*series))
        after.crosshairs.editOrAdd(frameOfReference(*series)).at =
            nearestIn(grid->geometry(), grid->curvedFromPatient(at));
    }
  }
  return after;
}

}  // namespace volumen
