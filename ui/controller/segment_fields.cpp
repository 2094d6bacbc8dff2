#include "ui/controller/segment_fields.h"

#include <utility>

#include "ui/workspace/segments.h"
#include "viewer/segment/occupancy.h"

namespace volumen {

std::shared_ptr<const OccupancyField> surfaceFieldOf(const LabelMap& labels, int number, const BitMask* kept,
                                                     const MadeSurface* before, const CancelToken& cancel) {
  if (before && before->field && holdSame(labels, *before->labels, std::uint8_t(number)))
    return before->field;
  BitMask voxels = maskOf(labels, std::uint8_t(number));
  if (kept) voxels = intersected(std::move(voxels), *kept);
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
    surfaces.push_back(surfaceOf(
        *segment, surfaceFieldOf(*map.labels, segment->number, kept ? &*kept : nullptr, nullptr, cancel)));
  return surfaces;
}

}  // namespace volumen
