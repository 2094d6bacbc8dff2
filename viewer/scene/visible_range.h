#pragma once

#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// Returns the curve restricted to a value range: its opacity inside the closed range, 0 outside, colours
/// kept. It is exact for every float32 value: the upper step stands at the next float32 above the range,
/// because the last of equal points holds at its value (picture.md 4). Ends may be infinite. At most four
/// points are added.
TransferFunction restrictedTo(const TransferFunction& curve, ValueRange range);

/// Returns the maximal spans of values with opacity > 0, ascending, as closed ranges of float32 values,
/// exactly as voxelsInRange() needs them. Spans are infinite where the curve's ends are visible. Gradient
/// opacity is ignored.
std::vector<ValueRange> visibleSpans(const TransferFunction& curve);

}  // namespace volumen
