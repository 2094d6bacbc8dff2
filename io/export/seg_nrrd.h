#pragma once

#include <string>

#include "viewer/segment/label_map.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Writes label 1 of `map` as a segmentation that 3D Slicer opens as one segment: `path` is NRRD (by custom
/// .seg.nrrd) with the fields of Slicer's segmentation format. `colour`: RGB 0..1. The file appears whole or
/// not at all; an Error names it.
Status writeSegNrrd(const LabelMap& map, const std::string& name, const glm::dvec3& colour,
                    const std::string& path, const CancelToken& cancel = {});

}  // namespace volumen
