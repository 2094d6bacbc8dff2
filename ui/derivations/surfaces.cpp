#include "ui/derivations/surfaces.h"

#include <algorithm>

#include "results/segments/segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_painter.h"

namespace volumen {

namespace {

constexpr const char* lacksMemory = "There was not enough memory for their surfaces.";

// Returns the maps drawn in 3D views on screen whose series are in memory.
std::vector<const SegmentMap*> mapsIn3d(const Session& session) {
  std::vector<const SegmentMap*> maps;
  for (const SeriesKey& series : seriesIn3d(session.workspace())) {
    const LoadedSeriesPtr shown = session.seriesNamed(series);
    if (!shown) continue;
    for (const SegmentMap* map : segmentMapsOf(session.workspace(), series))
      if (isOn(*map, shown->volume->geometry()) && !segmentsIn3d(*map).empty()) maps.push_back(map);
  }
  return maps;
}

KeptKey keptKeyOf(const SegmentMap& map, const Mask& mask) {
  return {map.series, mask, map.labels->geometry()};
}

bool isOnScreen(const SurfaceKey& key, const Workspace& workspace) {
  const SegmentMap* map = segmentMapOf(workspace, key.series, key.map);
  const std::vector<SeriesKey> shown = seriesIn3d(workspace);
  return map && findSegment(*map, key.number) && std::ranges::find(shown, key.series) != shown.end();
}

// Returns whether the segments of a series differ. A change of one map may free memory for the surfaces of
// another.
bool areSegmentsChanged(const Workspace& before, const Workspace& after, const SeriesKey& series) {
  return !std::ranges::equal(segmentMapsOf(before, series), segmentMapsOf(after, series),
                             [](const SegmentMap* a, const SegmentMap* b) { return a == b || *a == *b; });
}

}  // namespace

KeptVoxels::Rule keptVoxelsRule(const Session& session) {
  return {.wanted =
              [&session] {
                std::vector<KeptKey> keys;
                for (const SegmentMap* map : mapsIn3d(session))
                  if (const Mask mask = session.maskOf(map->series);
                      !mask.empty() && session.seriesWith(map->series, {}))
                    keys.push_back(keptKeyOf(*map, mask));
                return keys;
              },
          .work = [&session](const KeptKey& key, std::size_t) -> KeptVoxels::Work {
            return [whole = session.seriesWith(key.series, {})->volume, key](const Job& job) {
              return std::make_shared<const BitMask>(keptVoxels(*whole, key.mask, job.cancel()));
            };
          },
          .name = [](const KeptKey&) { return JobName(tr("Making surfaces of segments")); },
          .bytes = [](const BitMask& kept) { return kept.words().size() * sizeof(std::uint64_t); },
          .isKept =
              [&session](const KeptKey& key) {
                return std::ranges::any_of(mapsIn3d(session), [&](const SegmentMap* map) {
                  return keptKeyOf(*map, session.maskOf(map->series)) == key;
                });
              },
          .lacksMemory = lacksMemory};
}

SurfaceFields::Rule surfaceFieldsRule(const Session& session, const SegmentPainter& painter,
                                      const KeptVoxels& kept, const SurfaceFields& fields,
                                      std::size_t mostBytes) {
  const auto keptFor = [&kept](const SurfaceKey& key) {
    const auto* entry = kept.find({key.series, key.mask, key.labels->geometry()});
    return entry ? entry->value : nullptr;
  };
  return {.wanted =
              [&session, keptFor] {
                std::vector<SurfaceKey> wanted;
                for (const SegmentMap* map : mapsIn3d(session))
                  for (SurfaceKey& key : surfaceKeysOf(*map, session.maskOf(map->series)))
                    if (key.mask.empty() || keptFor(key)) wanted.push_back(std::move(key));
                return wanted;
              },
          .work = [&fields, keptFor](const SurfaceKey& key, std::size_t room) -> SurfaceFields::Work {
            SurfaceBefore before;
            for (const SurfaceFields::Entry& entry : fields.entries())
              if (entry.key.isOfSame(key) && entry.key.mask == key.mask)
                before = {entry.key.labels, entry.value};
            return [key, before, room, left = key.mask.empty() ? nullptr : keptFor(key)](const Job& job) {
              return surfaceFieldOf(key, before, left.get(), room, job.cancel());
            };
          },
          .name = [](const SurfaceKey&) { return JobName(tr("Making surfaces of segments")); },
          .bytes = bytesOf,
          .areVersions = [](const SurfaceKey& a, const SurfaceKey& b) { return a.isOfSame(b); },
          .isKept = [&session](const SurfaceKey& key) { return isOnScreen(key, session.workspace()); },
          .isPaused = [&painter] { return painter.isPainting(); },
          .isTriedAgain =
              [](const SurfaceFields::Entry& entry, const Workspace& before, const Workspace& after) {
                return areSegmentsChanged(before, after, entry.key.series);
              },
          .failure =
              [&session](const SurfaceKey& key, const std::string& whyNot) {
                const SegmentMap* map = segmentMapOf(session.workspace(), key.series, key.map);
                const Segment* segment = map ? findSegment(*map, key.number) : nullptr;
                return segment ? notDrawnText({{segment, QString::fromStdString(whyNot)}}) : QString();
              },
          .lacksMemory = lacksMemory,
          .wasCancelled = tr("Making their surfaces was cancelled.").toStdString(),
          .mostBytes = mostBytes};
}

}  // namespace volumen
