#include "ui/controller/segment_fields.h"

#include <QLocale>
#include <algorithm>
#include <optional>
#include <utility>

#include "ui/data/series_pool.h"
#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"
#include "viewer/segment/occupancy.h"

namespace volumen {

namespace {

QString megabytes(std::size_t bytes) {
  const double mb = double(bytes) / 1e6;
  return tr("%1 MB").arg(QLocale().toString(mb, 'f', mb < 10 ? 1 : 0));
}

// An Error means that the field would exceed `mostBytes`.
Result<std::shared_ptr<const OccupancyField>> fieldOf(const MadeSurface& made, const MadeSurface* before,
                                                      const BitMask* kept, std::size_t mostBytes,
                                                      const CancelToken& cancel) {
  const LabelMap& labels = *made.labels;
  const auto number = std::uint8_t(made.number);
  if (before && before->field && holdSame(labels, *before->labels, number)) return before->field;
  BitMask voxels = maskOf(labels, number);
  if (kept) voxels = intersected(std::move(voxels), *kept);
  if (const std::size_t bytes = occupancyBytes(voxels, surfaceSigma); bytes > mostBytes)
    return Error{tr("Its surface would take %1 of memory; %2 are left for surfaces.")
                     .arg(megabytes(bytes), megabytes(mostBytes))
                     .toStdString()};
  return std::make_shared<const OccupancyField>(occupancyOf(voxels, surfaceSigma, cancel));
}

}  // namespace

std::size_t mostSurfaceBytes() { return SeriesPool::partOfMemory(25); }

std::size_t bytesOf(const MadeSurface& surface) {
  return surface.field ? surface.field->values.size() * sizeof(float) : 0;
}

void makeFields(std::vector<MadeSurface>& surfaces, const std::vector<MadeSurface>& before,
                const BitMask* kept, std::size_t mostBytes, const CancelToken& cancel) {
  std::size_t left = mostBytes;
  for (std::size_t n = 0; n < surfaces.size() && !cancel.cancelled(); ++n) {
    MadeSurface& surface = surfaces[n];
    auto field = fieldOf(surface, n < before.size() ? &before[n] : nullptr, kept, left, cancel);
    if (field)
      surface.field = std::move(*field);
    else
      surface.whyNot = QString::fromStdString(field.message());
    left -= std::min(left, bytesOf(surface));
  }
}

std::vector<MadeSurface> surfacesOf(std::span<const SegmentMap> maps, const Volume& whole, const Mask& mask,
                                    std::size_t mostBytes, const CancelToken& cancel) {
  std::vector<MadeSurface> surfaces;
  for (const SegmentMap& map : maps)
    if (isOn(map, whole.geometry()))
      for (const Segment* segment : segmentsIn3d(map))
        surfaces.push_back({map.series, map.number, segment->number, map.labels, mask});
  std::optional<BitMask> kept;
  if (!surfaces.empty() && !mask.empty()) kept = keptVoxels(whole, mask, cancel);
  makeFields(surfaces, {}, kept ? &*kept : nullptr, mostBytes, cancel);
  return surfaces;
}

}  // namespace volumen
