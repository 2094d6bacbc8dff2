#include "results/segments/segment_surfaces.h"

#include <QLocale>
#include <QStringList>
#include <algorithm>
#include <utility>

#include "results/segments/region_colours.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "viewer/segment/occupancy.h"
#include "viewer/volume/available_memory.h"

namespace volumen {

namespace {

QString megabytes(std::size_t bytes) {
  const double mb = double(bytes) / 1e6;
  return tr("%1 MB").arg(QLocale().toString(mb, 'f', mb < 10 ? 1 : 0));
}

}  // namespace

QString notDrawnText(const std::vector<SegmentNotDrawn>& segments) {
  QStringList reasons, lines;
  for (const SegmentNotDrawn& one : segments)
    if (!reasons.contains(one.whyNot)) reasons << one.whyNot;
  for (const QString& reason : reasons) {
    QStringList names;
    for (const SegmentNotDrawn& one : segments)
      if (one.whyNot == reason) names << shownText(one.segment->label);
    lines << tr("Not drawn in 3D: %1. %2").arg(names.join(QStringLiteral(", ")), reason);
  }
  return lines.join(QLatin1Char('\n'));
}

std::vector<const Segment*> segmentsIn3d(const SegmentMap& map) {
  std::vector<const Segment*> shown;
  for (const Segment& segment : map.segments)
    if (map.in3d && segment.visible && segment.opacity > 0) shown.push_back(&segment);
  return shown;
}

SegmentSurface surfaceOf(const Segment& segment, FieldPtr field) {
  const QColor colour = regionColour(segment.colour, segment.number);
  return {std::move(field), glm::dvec3(colour.red(), colour.green(), colour.blue()) / 255.0, segment.opacity};
}

std::vector<SurfaceKey> surfaceKeysOf(const SegmentMap& map, const Mask& mask) {
  std::vector<SurfaceKey> keys;
  for (const Segment* segment : segmentsIn3d(map))
    keys.push_back({map.series, map.number, segment->number, map.labels, mask});
  return keys;
}

Result<FieldPtr> surfaceFieldOf(const SurfaceKey& key, const SurfaceBefore& before, const BitMask* kept,
                                std::size_t mostBytes, const CancelToken& cancel) {
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

std::size_t bytesOf(const OccupancyField& field) { return field.values.size() * sizeof(float); }

std::size_t mostSurfaceBytes() { return std::size_t(processMemory().most / 4); }

std::vector<std::pair<SurfaceKey, Result<FieldPtr>>> surfacesOf(std::span<const SegmentMap> maps,
                                                                const Volume& whole, const Mask& mask,
                                                                std::size_t mostBytes,
                                                                const CancelToken& cancel) {
  std::vector<SurfaceKey> keys;
  for (const SegmentMap& map : maps)
    if (isOn(map, whole.geometry())) std::ranges::move(surfaceKeysOf(map, mask), std::back_inserter(keys));
  std::optional<BitMask> kept;
  if (!keys.empty() && !mask.empty()) kept = keptVoxels(whole, mask, cancel);
  std::vector<std::pair<SurfaceKey, Result<FieldPtr>>> surfaces;
  std::size_t left = mostBytes;
  for (const SurfaceKey& key : keys) {
    if (cancel.cancelled()) break;
    Result<FieldPtr> field = surfaceFieldOf(key, {}, kept ? &*kept : nullptr, left, cancel);
    if (field) left -= bytesOf(**field);
    surfaces.emplace_back(key, std::move(field));
  }
  return surfaces;
}

}  // namespace volumen
