#pragma once

#include <span>
#include <string>

#include "viewer/segment/label_map.h"
#include "viewer/segment/segment.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Writes the segments of a label map, each the voxels of its number, as a segmentation that 3D Slicer opens:
/// `path` is NRRD (by custom .seg.nrrd) with the fields of Slicer's segmentation format; white where a
/// segment has no colour. The file appears whole or not at all; an Error names it.
Status writeSegNrrd(const LabelMap& map, std::span<const Segment> segments, const std::string& path,
                    const CancelToken& cancel = {});

}  // namespace volumen
