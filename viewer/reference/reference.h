#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "viewer/plan/plan.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/picture.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The true picture: picture.md's limit in double precision, within 0.05/255. One code path for everything;
/// shares no kernel with the fast methods. `scene` must be valid and complete (camera, window, gradientFloor
/// set, as a Plan's is). `threads` 0: all. An Error only where cancelled.
Result<Picture> renderReference(const Scene& scene, const Volume& volume, glm::ivec2 size, int threads = 0,
                                const CancelToken& cancel = {});

/// Which pixels are well-conditioned (design.md 2): the reference there changes by at most 0.1/255 (float,
/// premultiplied, any component) when the ray is moved sideways by 1e-4 voxel, in either of the picture's two
/// directions. One entry a pixel.
Result<std::vector<std::uint8_t>> wellConditioned(const Scene& scene, const Volume& volume, glm::ivec2 size,
                                                  int threads = 0, const CancelToken& cancel = {});

/// The reference at some pixels alone: what renderReference and wellConditioned say of them.
struct ReferencePixels {
  std::vector<glm::vec4> rgba;
  std::vector<std::uint8_t> well;
};
Result<ReferencePixels> referencePixels(const Scene& scene, const Volume& volume, glm::ivec2 size,
                                        const std::vector<glm::ivec2>& pixels, int threads = 0,
                                        const CancelToken& cancel = {});

}  // namespace volumen
