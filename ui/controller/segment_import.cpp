#include "ui/controller/segment_import.h"

#include <QFileInfo>
#include <algorithm>
#include <map>
#include <utility>

#include "io/export/read_segments.h"
#include "io/load.h"
#include "results/segments/segment_maps.h"
#include "results/segments/segments.h"
#include "results/text/text.h"

namespace volumen {

namespace {

// Returns "Tumour, Edema".
QString namesText(const QStringList& names) {
  constexpr int most = 5;
  QStringList told = names.mid(0, most);
  if (names.size() > most) told << tr("%1 more").arg(names.size() - most);
  return told.join(QStringLiteral(", "));
}

// Returns a sentence for each map other than the current one that received segments.
QStringList furtherText(const AddedSegments& added) {
  std::map<std::size_t, QStringList> names;
  for (const SegmentPlace& place : added.places)
    if (place.map > 0) names[place.map] << shownText(findSegment(added.maps[place.map], place.number)->label);
  QStringList sentences;
  for (const auto& [map, all] : names)
    sentences << tr("%1 holds what overlaps other segments: %2.")
                     .arg(mapName(added.maps[map].number), namesText(all));
  return sentences;
}

// Returns the maps with all segments of a file. The first one added becomes current, as does its map.
std::vector<SegmentMap> withSegmentsOf(const SegmentsFile& file, const QString& name,
                                       std::vector<SegmentMap> maps, QStringList& told) {
  AddedSegments all = withSegmentsAdded(std::move(maps), file.maps);
  const auto count = all.places.size();
  told << (count == 1 ? tr("Added a segment of %1.").arg(name)
                      : tr("Added %1 segments of %2.").arg(count).arg(name));
  for (const std::string& note : file.notes) told << shownText(note);
  if (std::ranges::any_of(file.maps, [](const Segmented& map) { return map.acquired != nullptr; }))
    told << tr(
        "The slices of the series are unevenly spaced: segments are drawn and measured on its even grid. "
        "Those that you do not change leave as they came.");
  told << furtherText(all);
  if (count == 0) return std::move(all.maps);
  SegmentMap& first = all.maps[all.places.front().map];
  first.current = all.places.front().number;
  std::swap(all.maps.front(), first);
  return std::move(all.maps);
}

// Returns the slices as acquired if they are not those that are drawn.
Result<AcquiredSlices> slicesOf(const Series& series, const CancelToken& cancel) {
  if (!series.regular) return AcquiredSlices{};
  const auto loaded = loadSeries(series, {}, cancel);
  if (!loaded) return loaded.error();
  return acquiredSlicesOf(*loaded);
}

}  // namespace

SegmentWork importOf(const QString& path, const Series& series, VolumePtr volume,
                     std::function<void(const QStringList& sentences)> told) {
  SegmentWork work;
  const QString name = shownText(QFileInfo(path).fileName().toStdString());
  const auto sentences = std::make_shared<QStringList>();
  work.series = keyOf(series);
  work.volume = std::move(volume);
  work.text = tr("Import segments");
  work.doing = tr("Importing segments");
  work.makeMaps = [path, name, series, grid = work.volume->geometry(), sentences](
                      const std::vector<SegmentMap>& maps,
                      const CancelToken& cancel) -> Result<std::vector<SegmentMap>> {
    const Result<AcquiredSlices> slices = slicesOf(series, cancel);
    if (!slices) return slices.error();
    const Result<SegmentsFile> file = readSegments(path.toStdString(), series, grid, {}, cancel, *slices);
    if (!file) return file.error();
    sentences->clear();
    return withSegmentsOf(*file, name, maps, *sentences);
  };
  work.done = [sentences, told = std::move(told)] { told(*sentences); };
  return work;
}

}  // namespace volumen
