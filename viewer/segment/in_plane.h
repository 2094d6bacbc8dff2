#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Diameters of one connected component of a segment in an acquired slice (constant k), as RECIST measures
/// lesions, in mm and patient space. Pixels that share an edge are connected. The endpoints lie on the
/// outline, which runs halfway between inside and outside pixels.
struct InPlaneDiameters {
  /// A line between two points of the outline.
  struct Line {
    double mm = 0;
    std::array<glm::dvec3, 2> at{};
  };
  int slice = 0;       ///< Index k
  Line longest;        ///< Longest diameter of all components; of equal ones, in the first slice
  Line perpendicular;  ///< Longest diameter of that component perpendicular to `longest`
};

/// Returns the diameters; empty if the mask is empty. The result is the same for any number of threads and
/// undefined if cancelled.
std::optional<InPlaneDiameters> inPlaneDiameters(const BitMask& mask, const CancelToken& cancel = {});

}  // namespace volumen
