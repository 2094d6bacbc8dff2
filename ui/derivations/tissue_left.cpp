#include "ui/derivations/tissue_left.h"

#include <algorithm>
#include <utility>

#include "results/segments/segment_surfaces.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_painter.h"
#include "viewer/scene/automatic.h"
#include "viewer/segment/mask.h"
#include "viewer/segment/table.h"

namespace volumen {

namespace {

// Returns the volume of a key. It shares the patient's voxels and the volume with `before` if these are
// equal.
Result<std::shared_ptr<const TissueVolume>> tissueLeft(const TissueKey& key, const TissueLeft::Entry& before,
                                                       const CancelToken& cancel) {
  const Volume& volume = *key.of->volume;
  TissueVolume made;
  if (key.withoutTable && before.value && before.key.withoutTable)
    made.patient = before.value->patient;
  else if (key.withoutTable)
    if (std::optional<BitMask> patient = patientBesideTable(volume, cancel))
      made.patient = std::make_shared<const BitMask>(std::move(*patient));
  if (key.segments.empty() && !made.patient) {
    made.left = key.of;
    return std::make_shared<const TissueVolume>(std::move(made));
  }
  if (key.segments.empty())
    made.voxels = made.patient;
  else if (BitMask voxels = tissueVoxels(key.segments, key.shown, cancel); made.patient)
    made.voxels = std::make_shared<const BitMask>(intersected(std::move(voxels), *made.patient));
  else
    made.voxels = std::make_shared<const BitMask>(std::move(voxels));
  if (before.value && before.value->voxels && *before.value->voxels == *made.voxels) {
    made.left = before.value->left;
    return std::make_shared<const TissueVolume>(std::move(made));
  }
  cancel.setDone(0.5);
  Result<VolumePtr> left = keptAlone(volume, *made.voxels, cancel, made.patient != nullptr);
  if (!left) return left.error();
  auto series = std::make_shared<LoadedSeries>(*key.of);
  series->volume = *left;
  made.left = std::move(series);
  return std::make_shared<const TissueVolume>(std::move(made));
}

// Returns whether the table of a CT is left out. Memory must have room for a second volume.
bool leavesTableOut(const Session& session, const LoadedSeriesPtr& series, const std::set<SeriesKey>& drawn) {
  if (series->series.modality != "CT" || series->series.curved) return false;
  const SeriesKey key = keyOf(series->series);
  const Preferences& preferences = session.preferences();
  return !preferences.tableIn3d && drawn.contains(key) && !session.maskOf(key).tableRemoved &&
         2 * series->volume->bytes() < SeriesPool::partOfMemory(preferences.memoryPercent) &&
         inHounsfield(*series->volume, series->histogram);
}

std::vector<TissueKey> wantedOf(const Session& session, const std::set<SeriesKey>& drawn) {
  std::vector<TissueKey> wanted;
  for (const SeriesKey& key : seriesIn3d(session.workspace()))
    if (const LoadedSeriesPtr series = session.seriesNamed(key))
      if (auto tissue = tissueWanted(segmentMapsOf(session.workspace(), key), series,
                                     leavesTableOut(session, series, drawn)))
        wanted.push_back(std::move(*tissue));
  return wanted;
}

// Returns whether the user shows the table of this series now; the volume without it is kept meanwhile.
bool isTableOnScreen(const Session& session, const TissueKey& key) {
  const std::vector<SeriesKey> shown = seriesIn3d(session.workspace());
  return key.segments.empty() && session.preferences().tableIn3d &&
         std::ranges::find(shown, keyOf(key.of->series)) != shown.end();
}

}  // namespace

TissueLeft::Rule tissueLeftRule(const Session& session, const SegmentPainter& painter,
                                const std::set<SeriesKey>& drawn, const TissueLeft& tissues) {
  return {
      .wanted = [&session, &drawn] { return wantedOf(session, drawn); },
      .work = [&session, &tissues](const TissueKey& key, std::size_t) -> TissueLeft::Work {
        TissueLeft::Entry before;
        for (const TissueLeft::Entry& entry : tissues.entries())
          if (entry.key.of == key.of) before = entry;
        return [key, before, pool = session.sharedPool()](const Job& job) {
          auto made = tissueLeft(key, before, job.cancel());
          if (made) pool->watch((*made)->left->volume);
          return made;
        };
      },
      .name =
          [](const TissueKey& key) {
            return JobName(key.segments.empty() ? tr("Looking for the table") : tr("Leaving tissue out"));
          },
      .bytes = bytesBesideVolumes,
      // A volume without the table is no substitute for one with tissue left out, nor the other way round.
      .areVersions =
          [](const TissueKey& a, const TissueKey& b) {
            return areOneSeries(a.of, b.of) && a.segments.empty() == b.segments.empty();
          },
      .isKept = [&session](const TissueKey& key) { return isTableOnScreen(session, key); },
      .isPaused = [&painter] { return painter.isPainting(); },
      .lacksMemory = "All of the volume is shown in 3D: there is not enough memory for a second one."};
}

}  // namespace volumen
