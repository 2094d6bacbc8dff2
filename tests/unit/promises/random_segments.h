#pragma once

#include "tests/fixtures/chance.h"
#include "viewer/scene/scene.h"

namespace volumen::tests {

/// Returns 1 to 4 segments in a volume, on its grid or another. They are balls, boxes, plates and crumbs,
/// which may be apart, nested, touching or cut off by the grid's border. Colours are random, about half are
/// opaque, and one in eight is invisible.
std::vector<SegmentSurface> randomSegments(Chance& chance, const VoxelGeometry& geometry);

}  // namespace volumen::tests
