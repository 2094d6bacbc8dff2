#include "ui/derivations/masked_volumes.h"

#include <span>

#include "results/text/text.h"
#include "ui/workspace/needed_series.h"
#include "viewer/scene/automatic.h"

namespace volumen {

namespace {

// A volume that lacks part of a mask: the table and the first `outlines` outlines.
struct CutVolume {
  VolumePtr volume;
  std::size_t outlines = 0;
};

// Returns the volume in memory that lacks most of the mask; nothing if only the whole volume is in memory.
std::optional<CutVolume> beforeLast(const Session& session, PoolKey key) {
  while (!key.mask.lassos.empty()) {
    key.mask.lassos.pop_back();
    if (key.mask.empty()) break;
    if (const LoadedSeriesPtr held = session.seriesWith(key.series, key.mask))
      return CutVolume{held->volume, key.mask.lassos.size()};
  }
  return {};
}

Result<LoadedSeriesPtr> maskedSeries(const LoadedSeries& whole, const std::optional<CutVolume>& before,
                                     const Mask& mask, const CancelToken& cancel) {
  if (mask.tableRemoved && !inHounsfield(*whole.volume, whole.histogram))
    return Error{tr("Only for CT: the values of this series are not Hounsfield units.").toStdString()};
  Result<VolumePtr> volume =
      before ? cutFurther(*before->volume, std::span(mask.lassos).subspan(before->outlines), cancel)
             : masked(*whole.volume, mask, cancel);
  if (!volume) return volume.error();
  auto without = std::make_shared<LoadedSeries>(whole);
  without->volume = *volume;
  if (mask.tableRemoved)
    without->warnings.emplace_back("The table was removed: what lies outside the patient is shown as air.");
  if (!mask.lassos.empty())
    without->warnings.emplace_back("Parts were cut away with the scissors: they are shown as air.");
  return LoadedSeriesPtr(without);
}

bool canBeMade(const Session& session, const PoolKey& key) {
  return !key.mask.empty() && !session.seriesWith(key.series, key.mask) && session.seriesWith(key.series, {});
}

}  // namespace

MaskedVolumes::Rule maskedVolumesRule(const Session& session, std::function<std::optional<PoolKey>()> next,
                                      std::function<bool()> isPaused) {
  return {.wanted =
              [&session, next = std::move(next)] {
                std::vector<PoolKey> wanted = seriesOnScreen(session.workspace());
                if (const std::optional<PoolKey> first = next()) wanted.insert(wanted.begin(), *first);
                std::erase_if(wanted, [&](const PoolKey& key) { return !canBeMade(session, key); });
                return wanted;
              },
          .work = [&session](const PoolKey& key, std::size_t) -> MaskedVolumes::Work {
            return [whole = session.seriesWith(key.series, {}), before = beforeLast(session, key),
                    mask = key.mask](const Job& job) {
              return maskedSeries(*whole, before, mask, job.cancel());
            };
          },
          .name =
              [](const PoolKey& key) {
                return JobName(key.mask.lassos.empty() ? tr("Removing table") : tr("Cutting"));
              },
          .bytes = [](const LoadedSeries&) { return std::size_t(0); },
          .isPaused = std::move(isPaused),
          .isTriedAgain = [](const MaskedVolumes::Entry& entry, const Workspace&,
                             const Workspace&) { return entry.isCancelled; },
          .lacksMemory = outOfMemory};
}

}  // namespace volumen
