#include "ui/derivations/surfaces.h"

#include <QLocale>
#include <algorithm>

#include "ui/controller/segment_painter.h"
#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"
#include "viewer/segment/occupancy.h"

namespace volumen {

namespace {

constexpr const char* lacksMemory = "There was not enough memory for their surfaces.";

QString megabytes(std::size_t bytes) {
  const double mb = double(bytes) / 1e6;
  return tr("%1 MB").arg(QLocale().toString(mb, 'f', mb < 10 ? 1 : 0));
}

std::size_t bytesOf(const OccupancyField& field) { return field.values.size() * sizeof(float); }

std::vector<SurfaceKey> keysOf(const SegmentMap& map, const Mask& mask) {
  std::vector<SurfaceKey> keys;
  for (const Segment* segment : segmentsIn3d(map))
    keys.push_back({map.series, map.number, segment->number, map.labels, mask});
  return keys;
}

// The last field of a segment under the same mask, and its labels.
struct Before {
  std::shared_ptr<const LabelMap> labels;
  FieldPtr field;  // null: there is none
};

// Returns the field of a segment, or that of `before` if no voxel has changed. `kept` restricts its voxels;
// null keeps all. The Error says that the field would exceed `mostBytes`.
Result<FieldPtr> fieldOf(const SurfaceKey& key, const Before& before, const BitMask* kept,
                         std::size_t mostBytes, const CancelToken& cancel = {}) {
  const auto number = std::uint8_t(key.number);
  if (before.field && holdSame(*key.labels, *before.labels, number)) return before.field;
  BitMask voxels = maskOf(*key.labels, number);
  if (kept) voxels = intersected(std::move(voxels), *kept);
  if (const std::size_t bytes = occupancyBytes(voxels, surfaceSigma); bytes > mostBytes)
    return Error{tr("Its surface would take %1 of memory; %2 are left for surfaces.")
                     .arg(megabytes(bytes), megabytes(mostBytes))
                     .toStdString()};
  return std::make_shared<const OccupancyField>(occupancyOf(voxels, surfaceSigma, cancel));
}

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
                  for (SurfaceKey& key : keysOf(*map, session.maskOf(map->series)))
                    if (key.mask.empty() || keptFor(key)) wanted.push_back(std::move(key));
                return wanted;
              },
          .work = [&fields, keptFor](const SurfaceKey& key, std::size_t room) -> SurfaceFields::Work {
            Before before;
            for (const SurfaceFields::Entry& entry : fields.entries())
              if (entry.key.isOfSame(key) && entry.key.mask == key.mask)
                before = {entry.key.labels, entry.value};
            return [key, before, room, left = key.mask.empty() ? nullptr : keptFor(key)](const Job& job) {
              return fieldOf(key, before, left.get(), room, job.cancel());
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

std::size_t mostSurfaceBytes() { return SeriesPool::partOfMemory(25); }

std::vector<std::pair<SurfaceKey, Result<FieldPtr>>> surfacesOf(std::span<const SegmentMap> maps,
                                                                const Volume& whole, const Mask& mask,
                                                                std::size_t mostBytes,
                                                                const CancelToken& cancel) {
  std::vector<SurfaceKey> keys;
  for (const SegmentMap& map : maps)
    if (isOn(map, whole.geometry())) std::ranges::move(keysOf(map, mask), std::back_inserter(keys));
  std::optional<BitMask> kept;
  if (!keys.empty() && !mask.empty()) kept = keptVoxels(whole, mask, cancel);
  std::vector<std::pair<SurfaceKey, Result<FieldPtr>>> surfaces;
  std::size_t left = mostBytes;
  for (const SurfaceKey& key : keys) {
    if (cancel.cancelled()) break;
    Result<FieldPtr> field = fieldOf(key, {}, kept ? &*kept : nullptr, left, cancel);
    if (field) left -= bytesOf(**field);
    surfaces.emplace_back(key, std::move(field));
  }
  return surfaces;
}

}  // namespace volumen
