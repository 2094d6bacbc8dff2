#pragma once

#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// The curve for seeing a value range alone: its opacity inside the closed range, 0 outside, colours kept.
/// Exact for every float32 value (the upper step stands at the next float32 above the range, because
/// picture.md 4 holds the last of equal points at its value). Ends may be infinite. Has at most four points
/// more than `curve`.
TransferFunction restrictedTo(const TransferFunction& curve, ValueRange range);

/// The maximal spans of values with opacity > 0, ascending, as closed ranges of float32 values: exactly those
/// that voxelsInRange() needs to find what is seen. Ends are infinite where the curve's ends are visible.
/// Gradient opacity is ignored.
std::vector<ValueRange> visibleSpans(const TransferFunction& curve);

}  // namespace volumen
