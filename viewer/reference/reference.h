#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "viewer/plan/plan.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/picture.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Renders the true picture: picture.md's limit in double precision, within 0.05/255. One code path serves
/// everything and shares no kernel with the fast methods. `scene` must be valid and complete (camera, window,
/// gradientFloor set, as in a Plan). `threads` 0: all. Returns an Error only if cancelled.
Result<Picture> renderReference(const Scene& scene, const Volume& volume, glm::ivec2 size, int threads = 0,
                                const CancelToken& cancel = {});

/// Returns which pixels are well-conditioned (design.md 2), one entry per pixel. There, moving the ray
/// sideways by 1e-4 voxel in either direction of the picture changes the reference by at most 0.1/255 (float,
/// premultiplied, any component).
Result<std::vector<std::uint8_t>> wellConditioned(const Scene& scene, const Volume& volume, glm::ivec2 size,
                                                  int threads = 0, const CancelToken& cancel = {});

/// Results of renderReference and wellConditioned at some pixels alone.
struct ReferencePixels {
  std::vector<glm::vec4> rgba;
  std::vector<std::uint8_t> well;
};
Result<ReferencePixels> referencePixels(const Scene& scene, const Volume& volume, glm::ivec2 size,
                                        const std::vector<glm::ivec2>& pixels, int threads = 0,
                                        const CancelToken& cancel = {});

}  // namespace volumen
