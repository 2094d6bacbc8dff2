#include "ui/controller/tissue_jobs.h"

#include <algorithm>
#include <new>
#include <utility>

#include "viewer/scene/automatic.h"
#include "viewer/segment/mask.h"
#include "viewer/segment/table.h"

namespace volumen {

namespace {

// Reuses the part of the old result whose voxels are unchanged.
Result<MadeTissue> withTissueLeft(MadeTissue wanted, const std::optional<MadeTissue>& before,
                                  const CancelToken& cancel) try {
  const Volume& volume = *wanted.of->volume;
  const bool isOfBefore = before && before->left && before->of == wanted.of;
  if (wanted.withoutTable && isOfBefore && before->withoutTable)
    wanted.patient = before->patient;
  else if (wanted.withoutTable)
    if (std::optional<BitMask> patient = patientBesideTable(volume, cancel))
      wanted.patient = std::make_shared<const BitMask>(std::move(*patient));
  if (wanted.segments.empty() && !wanted.patient) {
    wanted.left = wanted.of;
    return wanted;
  }
  if (wanted.segments.empty())
    wanted.voxels = wanted.patient;
  else if (BitMask voxels = tissueVoxels(wanted.segments, wanted.shown, cancel); wanted.patient)
    wanted.voxels = std::make_shared<const BitMask>(intersected(std::move(voxels), *wanted.patient));
  else
    wanted.voxels = std::make_shared<const BitMask>(std::move(voxels));
  if (isOfBefore && before->voxels && *before->voxels == *wanted.voxels) {
    wanted.left = before->left;
    return wanted;
  }
  cancel.setDone(0.5);
  Result<VolumePtr> left = keptAlone(volume, *wanted.voxels, cancel, wanted.patient != nullptr);
  if (!left) return left.error();
  auto series = std::make_shared<LoadedSeries>(*wanted.of);
  series->volume = *left;
  wanted.left = std::move(series);
  return wanted;
} catch (const std::bad_alloc&) {
  return Error{"All of the volume is shown in 3D: there is not enough memory for a second one."};
}

}  // namespace

TissueJobs::TissueJobs(Session& session, const SegmentPainter& painter, Jobs& jobs, QObject* parent)
    : QObject(parent), session_(session), painter_(painter), lane_(&jobs) {
  connect(&session_, &Session::workspaceChanged, this, &TissueJobs::next);
  connect(&session_, &Session::preferencesChanged, this, &TissueJobs::next);
  // From the event loop, because Esc undoes the steps since the press once the stroke has ended.
  connect(&painter_, &SegmentPainter::ended, this, &TissueJobs::next, Qt::QueuedConnection);
  next();
}

void TissueJobs::drew(const SeriesKey& series) {
  if (drawn_.insert(series).second) next();
}

// Applies to series already drawn, if memory has room for a second volume.
bool TissueJobs::leavesTableOut(const LoadedSeriesPtr& series) const {
  if (!series || series->series.modality != "CT" || series->series.curved) return false;
  const SeriesKey key = keyOf(series->series);
  const auto known = withoutTable_.find(key);
  if (known != withoutTable_.end() && known->second.lock() == series) return false;
  const Preferences& preferences = session_.preferences();
  return !preferences.tableIn3d && drawn_.contains(key) && !session_.maskOf(key).tableRemoved &&
         2 * series->volume->bytes() < SeriesPool::partOfMemory(preferences.memoryPercent) &&
         inHounsfield(*series->volume, series->histogram);
}

void TissueJobs::next() {
  if (painter_.isPainting()) return;
  const std::optional<MadeTissue> wanted = firstWanted();
  if (lane_.isBusy()) {
    if (wanted && wanted->isAs(*underWay_)) return;
    lane_.giveUpAll();
  }
  underWay_ = wanted;
  if (wanted) begin(*wanted);
}

// Returns the first series in 3D views on screen whose volume is missing.
std::optional<MadeTissue> TissueJobs::firstWanted() const {
  const Workspace& workspace = session_.workspace();
  for (const ViewId id : viewsOnScreen(workspace)) {
    const ViewState& view = workspace.view(id);
    if (!showsScene(view.kind)) continue;
    const LoadedSeriesPtr series = session_.seriesOf(id);
    const auto wanted = tissueWanted(segmentMapsOf(workspace, view.series), series, leavesTableOut(series));
    if (!wanted) continue;
    const bool isMade =
        std::ranges::any_of(session_.tissues(), [&](const MadeTissue& made) { return made.isAs(*wanted); });
    if (!isMade) return wanted;
  }
  return {};
}

// If there is no table, nothing is removed and the search is not repeated.
void TissueJobs::take(MadeTissue made) {
  if (made.withoutTable && made.left && !made.patient) {
    withoutTable_[keyOf(made.of->series)] = made.of;
    made.withoutTable = false;
  }
  if (made.left != made.of) return session_.takeTissue(std::move(made));
  next();
}

// Failed or cancelled volumes are retried only after a change.
void TissueJobs::begin(const MadeTissue& wanted) {
  std::optional<MadeTissue> before;
  for (const MadeTissue& made : session_.tissues())
    if (made.of == wanted.of) before = made;
  lane_.run(
      wanted.segments.empty() ? tr("Looking for the table") : tr("Leaving tissue out"),
      [wanted, before](const Job& job) { return withTissueLeft(wanted, before, job.cancel()); },
      [this, wanted](Result<MadeTissue> made) {
        if (!made) Q_EMIT failed(QString::fromStdString(made.message()));
        take(made ? *std::move(made) : wanted);
      },
      [this, wanted] { session_.takeTissue(wanted); });
}

}  // namespace volumen
