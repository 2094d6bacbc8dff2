#include "ui/controller/segment_fields.h"

#include <QLocale>
#include <limits>
#include <utility>

#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"
#include "viewer/segment/occupancy.h"

namespace volumen {

namespace {

QString megabytes(std::size_t bytes) {
  const double mb = double(bytes) / 1e6;
  return tr("%1 MB").arg(QLocale().toString(mb, 'f', mb < 10 ? 1 : 0));
}

}  // namespace

Result<std::shared_ptr<const OccupancyField>> surfaceFieldOf(const LabelMap& labels, int number,
                                                             const BitMask* kept, std::size_t mostBytes,
                                                             const MadeSurface* before,
                                                             const CancelToken& cancel) {
  if (before && before->field && holdSame(labels, *before->labels, std::uint8_t(number)))
    return before->field;
  BitMask voxels = maskOf(labels, std::uint8_t(number));
  if (kept) voxels = intersected(std::move(voxels), *kept);
  if (const std::size_t bytes = occupancyBytes(voxels, surfaceSigma); bytes > mostBytes)
    return Error{tr("Its surface would take %1 of memory; %2 are left for surfaces.")
                     .arg(megabytes(bytes), megabytes(mostBytes))
                     .toStdString()};
  return std::make_shared<const OccupancyField>(occupancyOf(voxels, surfaceSigma, cancel));
}

std::vector<SegmentSurface> surfacesOf(const SegmentMap& map, const Volume& whole, const Mask& mask,
                                       const CancelToken& cancel) {
  std::vector<SegmentSurface> surfaces;
  const std::vector<const Segment*> shown = segmentsIn3d(map);
  if (shown.empty() || !isOn(map, whole.geometry())) return surfaces;
  std::optional<BitMask> kept;
  if (!mask.empty()) kept = keptVoxels(whole, mask, cancel);
  for (const Segment* segment : shown)
    surfaces.push_back(
        surfaceOf(*segment, *surfaceFieldOf(*map.labels, segment->number, kept ? &*kept : nullptr,
                                            std::numeric_limits<std::size_t>::max(), nullptr, cancel)));
  return surfaces;
}

}  // namespace volumen
