#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Diameters of a segment in one slice as acquired (voxels of one k), as RECIST measures lesions: patient mm.
/// Their ends lie on the outline of its pixels, which passes halfway between pixels inside and outside.
struct InPlaneDiameters {
  /// A line between two points of the outline.
  struct Line {
    double mm = 0;
    std::array<glm::dvec3, 2> at{};
  };
  int slice = 0;       ///< k
  Line longest;        ///< the longest of all slices; of equal ones that of the first
  Line perpendicular;  ///< the longest in that slice at right angles to it
};

/// None where the mask is empty. The same for any number of threads; cancelled: any.
std::optional<InPlaneDiameters> inPlaneDiameters(const BitMask& mask, const CancelToken& cancel = {});

}  // namespace volumen
