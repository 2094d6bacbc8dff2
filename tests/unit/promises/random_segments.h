#pragma once

#include "tests/fixtures/chance.h"
#include "viewer/scene/scene.h"

namespace volumen::tests {

/// 1 to 4 segments in a volume, on its grid or another: balls, boxes, plates and crumbs, apart, within one
/// another, touching or cut off by the grid's border; of any colour, half of them opaque, one in eight
/// invisible.
std::vector<SegmentSurface> randomSegments(Chance& chance, const VoxelGeometry& geometry);

}  // namespace volumen::tests
