#include "ui/controller/segment_surface_jobs.h"

#include <algorithm>
#include <new>

#include "ui/controller/segment_fields.h"
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

SegmentSurfaceJobs::SegmentSurfaceJobs(Session& session, Jobs& jobs, QObject* parent)
    : QObject(parent), session_(session), lane_(&jobs) {
  connect(&session_, &Session::workspaceChanged, this, &SegmentSurfaceJobs::next);
  next();
}

void SegmentSurfaceJobs::next() {
  if (lane_.isBusy()) return;
  for (const SeriesKey& series : seriesIn3d(session_.workspace())) {
    const LoadedSeriesPtr shown = session_.seriesNamed(series);
    if (!shown) continue;
    for (const SegmentMap* map : segmentMapsOf(session_.workspace(), series)) {
      if (!isOn(*map, shown->volume->geometry())) continue;
      const Wanted wanted = wantedOf(*map);
      const bool canBegin = !wanted.kept || wanted.kept->voxels || wanted.whole;
      if (!wanted.surfaces.empty() && canBegin) return begin(wanted);
    }
  }
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
    if (isThere && before->labels == map.labels) continue;
    wanted.before.push_back(isThere ? *before : MadeSurface());
    wanted.surfaces.push_back(std::move(surface));
  }
  if (mask.empty()) return wanted;
  // A series that was closed may have been opened again with other slices.
  const bool isKnown = kept_ && kept_->series == map.series && kept_->mask == mask &&
                       kept_->voxels->geometry() == map.labels->geometry();
  wanted.kept = isKnown ? *kept_ : Kept{map.series, mask, nullptr};
  if (const LoadedSeriesPtr whole = session_.seriesWith(map.series, {})) wanted.whole = whole->volume;
  return wanted;
}

void SegmentSurfaceJobs::begin(const Wanted& wanted) {
  lane_.run(
      tr("Making surfaces of segments"), [wanted](const Job& job) { return made(wanted, job.cancel()); },
      [this, surfaces = wanted.surfaces](Result<Made> result) {
        if (!result) {
          giveUp(surfaces);
          Q_EMIT failed(QString::fromStdString(result.message()));
          return;
        }
        if (result->kept) kept_ = std::move(result->kept);
        session_.takeSurfaces(std::move(result->surfaces));
      },
      [this, surfaces = wanted.surfaces] { giveUp(surfaces); });
}

// They are made again once something changes.
void SegmentSurfaceJobs::giveUp(std::vector<MadeSurface> surfaces) {
  session_.takeSurfaces(std::move(surfaces));
}

Result<SegmentSurfaceJobs::Made> SegmentSurfaceJobs::made(const Wanted& wanted,
                                                          const CancelToken& cancel) try {
  Made all{wanted.surfaces, wanted.kept};
  if (all.kept && !all.kept->voxels)
    all.kept->voxels = std::make_shared<const BitMask>(keptVoxels(*wanted.whole, all.kept->mask, cancel));
  const BitMask* kept = all.kept ? all.kept->voxels.get() : nullptr;
  for (std::size_t n = 0; n < all.surfaces.size() && !cancel.cancelled(); ++n)
    all.surfaces[n].field =
        surfaceFieldOf(*all.surfaces[n].labels, all.surfaces[n].number, kept, &wanted.before[n], cancel);
  return all;
} catch (const std::bad_alloc&) {
  return Error{"Segments are not shown in 3D: there is not enough memory for their surfaces."};
}

}  // namespace volumen
