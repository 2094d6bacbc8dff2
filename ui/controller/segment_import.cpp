#include "ui/controller/segment_import.h"

#include <QFileInfo>
#include <QLocale>
#include <utility>

#include "io/export/read_segments.h"
#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"
#include "ui/workspace/value_text.h"
#include "viewer/segment/added_labels.h"

namespace volumen {

namespace {

// "0.30 of 3.40 ml of Tumour".
QString lossText(const Segment& segment, std::int64_t lost, std::int64_t wanted, const VoxelGeometry& grid) {
  const QString name = shownText(segment.label);
  const auto voxels = [](std::int64_t count) { return QLocale().toString(qlonglong(count)); };
  if (!grid.calibrated) return tr("%1 of %2 voxels of %3").arg(voxels(lost), voxels(wanted), name);
  const auto ml = [&](std::int64_t count) {
    return digitsText(double(count) * grid.voxelVolume() / 1000, 3);
  };
  return tr("%1 of %2 ml of %3").arg(ml(lost), ml(wanted), name);
}

// With the segments of a layer. What each of them has lost to those before is added to `losses`.
SegmentMap withLayer(SegmentMap map, const Segmented& layer, QStringList& losses) {
  std::array<std::uint8_t, 256> numbers{};
  for (const Segment& segment : layer.segments) {
    map = withSegmentAdded(std::move(map), segment);
    numbers[std::size_t(segment.number)] = std::uint8_t(map.current);
  }
  AddedLabels added = withLabelsAdded(*map.labels, layer.labels, numbers);
  map.labels = std::make_shared<const LabelMap>(std::move(added.labels));
  for (const Segment& segment : layer.segments) {
    const auto n = std::size_t(segment.number);
    if (added.lost[n] > 0)
      losses << lossText(segment, added.lost[n], added.wanted[n], map.labels->geometry());
  }
  return map;
}

QString lossesText(const QStringList& losses) {
  constexpr int most = 5;
  QStringList told = losses.mid(0, most);
  if (losses.size() > most) told << tr("and of %1 more").arg(losses.size() - most);
  return tr("Each voxel is in one segment, the one that was there before; left out: %1.")
      .arg(told.join(QStringLiteral(", ")));
}

// With all segments of a file, the first of them current.
Result<SegmentMap> withSegmentsOf(const SegmentsFile& file, const QString& name, SegmentMap map,
                                  QStringList& told) {
  constexpr std::size_t most = 255;
  std::size_t count = 0;
  for (const Segmented& layer : file.maps) count += layer.segments.size();
  if (map.segments.size() + count > most)
    return Error{tr("%1 has %2 segments, and there are %3: at most 255 fit.")
                     .arg(name, QString::number(count), QString::number(map.segments.size()))
                     .toStdString()};
  const std::size_t first = map.segments.size();
  QStringList losses;
  for (const Segmented& layer : file.maps) map = withLayer(std::move(map), layer, losses);
  map.current = map.segments[first].number;
  told << (count == 1 ? tr("Added a segment of %1.").arg(name)
                      : tr("Added %1 segments of %2.").arg(count).arg(name));
  for (const std::string& note : file.notes) told << shownText(note);
  if (!losses.isEmpty()) told << lossesText(losses);
  return map;
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
  work.makeAll = [path, name, series, grid = work.volume->geometry(), sentences](
                     const SegmentMap& map, const CancelToken& cancel) -> Result<SegmentMap> {
    const Result<SegmentsFile> file = readSegments(path.toStdString(), series, grid, {}, cancel);
    if (!file) return file.error();
    sentences->clear();
    return withSegmentsOf(*file, name, map, *sentences);
  };
  work.done = [sentences, told = std::move(told)] { told(*sentences); };
  return work;
}

}  // namespace volumen
