#include "ui/controller/segment_surface_jobs.h"

#include <algorithm>
#include <new>

#include "ui/workspace/segments.h"

namespace volumen {

namespace {

std::vector<SeriesKey> seriesIn3d(const Workspace& workspace) {
  std::vector<SeriesKey> all;
  for (const ViewId id : viewsOnScreen(workspace)) {
    const ViewState& view = workspace.view(id);
    if (showsScene(view.kind) && std::ranges::find(all, view.series) == all.end()) all.push_back(view.series);
  }
  return all;
}

}  // namespace

SegmentSurfaceJobs::SegmentSurfaceJobs(Session& session, const SegmentPainter& painter, Jobs& jobs,
                                       std::size_t mostBytes, QObject* parent)
    : QObject(parent), session_(session), painter_(painter), mostBytes_(mostBytes), lane_(&jobs) {
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (before.segmentMaps != after.segmentMaps) noteChanges(before, after);
            next();
          });
  connect(&painter_, &SegmentPainter::ended, this, &SegmentSurfaceJobs::next);
  next();
}

// A change of one map may free memory for the surfaces of another.
void SegmentSurfaceJobs::noteChanges(const Workspace& before, const Workspace& after) {
  const auto areOne = [](const SegmentMap* a, const SegmentMap* b) { return a == b || *a == *b; };
  for (const SegmentMap& map : after.segmentMaps)
    if (!std::ranges::equal(segmentMapsOf(before, map.series), segmentMapsOf(after, map.series), areOne))
      again_.insert({map.series, map.number});
}

void SegmentSurfaceJobs::next() {
  session_.pool().count(this, bytesBeside({}));
  if (painter_.isPainting()) return;
  if (lane_.isBusy() && isInVain()) lane_.giveUpAll();
  if (lane_.isBusy()) return;
  for (const SeriesKey& series : seriesIn3d(session_.workspace())) {
    const LoadedSeriesPtr shown = session_.seriesNamed(series);
    if (!shown) continue;
    for (const SegmentMap* map : segmentMapsOf(session_.workspace(), series)) {
      if (!isOn(*map, shown->volume->geometry())) continue;
      const Wanted wanted = wantedOf(*map);
      const bool canBegin = !wanted.kept || wanted.kept->voxels || wanted.whole;
      if (wanted.surfaces.empty()) again_.erase({series, map->number});
      if (!wanted.surfaces.empty() && canBegin) return begin(wanted);
    }
  }
}

// Returns whether the job is obsolete because its map is as before and has its surfaces. A cancelled stroke
// does that.
bool SegmentSurfaceJobs::isInVain() const {
  const SegmentMap* map = segmentMapOf(session_.workspace(), underWay_.series, underWay_.map);
  return map && map->labels && map->labels != underWay_.labels && wantedOf(*map).surfaces.empty();
}

SegmentSurfaceJobs::Wanted SegmentSurfaceJobs::wantedOf(const SegmentMap& map) const {
  Wanted wanted;
  const Mask mask = session_.maskOf(map.series);
  for (const Segment* segment : segmentsIn3d(map)) {
    MadeSurface surface{map.series, map.number, segment->number, map.labels, mask};
    const auto before = std::ranges::find_if(session_.surfaces(), [&](const MadeSurface& made) {
      return made.isOfSame(surface) && made.mask == mask;
    });
    const bool isThere = before != session_.surfaces().end();
    const bool isTriedAgain = isThere && !before->field && again_.contains({map.series, map.number});
    if (isThere && before->labels == map.labels && !isTriedAgain) continue;
    wanted.before.push_back(isThere ? *before : MadeSurface());
    wanted.surfaces.push_back(std::move(surface));
  }
  wanted.mostBytes = mostBytes_ - std::min(mostBytes_, bytesBeside(wanted.surfaces));
  if (mask.empty()) return wanted;
  // A series may have been closed and opened again with other slices.
  const bool isKnown = kept_ && kept_->series == map.series && kept_->mask == mask &&
                       kept_->voxels->geometry() == map.labels->geometry();
  wanted.kept = isKnown ? *kept_ : Kept{map.series, mask, nullptr};
  if (const LoadedSeriesPtr whole = session_.seriesWith(map.series, {})) wanted.whole = whole->volume;
  return wanted;
}

// Returns the memory of the surfaces that stay unchanged.
std::size_t SegmentSurfaceJobs::bytesBeside(const std::vector<MadeSurface>& wanted) const {
  std::size_t bytes = 0;
  for (const MadeSurface& made : session_.surfaces()) {
    const bool isReplaced =
        std::ranges::any_of(wanted, [&](const MadeSurface& surface) { return surface.isOfSame(made); });
    if (!isReplaced) bytes += bytesOf(made);
  }
  return bytes;
}

void SegmentSurfaceJobs::begin(const Wanted& wanted) {
  underWay_ = wanted.surfaces.front();
  again_.erase({underWay_.series, underWay_.map});
  lane_.run(
      tr("Making surfaces of segments"), [wanted](const Job& job) { return made(wanted, job.cancel()); },
      [this, wanted](Result<Made> result) {
        if (!result) {
          giveUp(wanted.surfaces, tr("There was not enough memory for their surfaces."));
          Q_EMIT failed(QString::fromStdString(result.message()));
          return;
        }
        if (result->kept) kept_ = std::move(result->kept);
        const bool lacksRoom = std::ranges::any_of(
            result->surfaces, [](const MadeSurface& surface) { return !surface.whyNot.isEmpty(); });
        if (lacksRoom && session_.dropHiddenSurfaces()) return tryAgain(wanted);
        session_.takeSurfaces(result->surfaces);
        tellRefused(wanted, result->surfaces);
      },
      [this, surfaces = wanted.surfaces] {
        giveUp(surfaces, tr("Making their surfaces was cancelled."));
        Q_EMIT cancelled(
            tr("Segments are not drawn in 3D until one is changed, or In 3D is switched off and on."));
      });
}

void SegmentSurfaceJobs::tryAgain(const Wanted& wanted) {
  again_.insert({wanted.surfaces.front().series, wanted.surfaces.front().map});
  next();
}

// Reports surfaces that would take too much memory, once while that lasts.
void SegmentSurfaceJobs::tellRefused(const Wanted& wanted, const std::vector<MadeSurface>& made) {
  const SegmentMap* map = segmentMapOf(session_.workspace(), made.front().series, made.front().map);
  std::vector<SegmentNotDrawn> refused;
  for (std::size_t n = 0; map && n < made.size(); ++n) {
    const Segment* segment = findSegment(*map, made[n].number);
    if (segment && !made[n].whyNot.isEmpty() && wanted.before[n].whyNot.isEmpty())
      refused.push_back({segment, made[n].whyNot});
  }
  if (!refused.empty()) Q_EMIT failed(notDrawnText(refused));
}

// Changes made during the job are no reason to retry.
void SegmentSurfaceJobs::giveUp(std::vector<MadeSurface> surfaces, const QString& why) {
  again_.erase({surfaces.front().series, surfaces.front().map});
  for (MadeSurface& surface : surfaces) surface.whyNot = why;
  session_.takeSurfaces(std::move(surfaces));
}

Result<SegmentSurfaceJobs::Made> SegmentSurfaceJobs::made(const Wanted& wanted,
                                                          const CancelToken& cancel) try {
  Made all{wanted.surfaces, wanted.kept};
  if (all.kept && !all.kept->voxels)
    all.kept->voxels = std::make_shared<const BitMask>(keptVoxels(*wanted.whole, all.kept->mask, cancel));
  const BitMask* kept = all.kept ? all.kept->voxels.get() : nullptr;
  makeFields(all.surfaces, wanted.before, kept, wanted.mostBytes, cancel);
  return all;
} catch (const std::bad_alloc&) {
  return Error{"Segments are not shown in 3D: there is not enough memory for their surfaces."};
}

}  // namespace volumen
