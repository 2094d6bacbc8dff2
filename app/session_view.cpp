#include "app/session_view.h"

#include <algorithm>

#include "app/progress.h"
#include "results/segments/segment_surfaces.h"
#include "results/segments/segments.h"
#include "results/segments/tissue.h"
#include "ui/controller/open_session.h"

namespace volumen {

namespace {

Result<SessionView> viewOf(const std::string& path, const OpenedSession& session) {
  const Workspace& workspace = session.workspace;
  const ViewState& view = workspace.view(sceneViewOf(workspace));
  const auto look = view.scenes.find(view.series);
  if (look == view.scenes.end()) return Error{path + " shows no series in 3D."};
  const SeriesState& shown = workspace.series.at(view.series);
  if (shown.missing) return Error{path + ": " + session.problems.join(QLatin1Char(' ')).toStdString()};
  SessionView read{*shown.series, shown.mask, look->second.scene, {}, {}};
  const std::vector<const SegmentMap*> maps = segmentMapsOf(workspace, view.series);
  const bool isShown = std::ranges::any_of(maps, [](const SegmentMap* map) {
    return !segmentsIn3d(*map).empty() || map->tissue.where != TissueShown::Where::everywhere;
  });
  for (const SegmentMap* map : maps)
    if (isShown) read.segments.push_back(*map);
  if (workspace.goal.aim == Aim::level) read.quality = workspace.goal.level.quality;
  return read;
}

}  // namespace

Result<SessionView> readSessionView(const std::string& path, const CancelToken& cancel) {
  const auto session = openSession(path, terminalProgress(), cancel);
  endTerminalProgress();
  if (!session) return session.error();
  return viewOf(path, *session);
}

bool showsTissueApart(const SessionView& session, const Volume& volume) {
  return std::ranges::any_of(session.segments, [&](const SegmentMap& map) {
    return map.tissue.where != TissueShown::Where::everywhere && isOn(map, volume.geometry());
  });
}

Result<VolumePtr> tissueAlone(const SessionView& session, const Volume& volume, const CancelToken& cancel) {
  std::vector<const SegmentMap*> maps;
  for (const SegmentMap& map : session.segments) maps.push_back(&map);
  const BitMask voxels = tissueVoxels(segmentsShownOf(maps, volume.geometry()), maps.front()->tissue, cancel);
  return keptAlone(volume, voxels, cancel);
}

}  // namespace volumen
