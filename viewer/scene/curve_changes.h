#pragma once

#include "viewer/scene/scene.h"

namespace volumen {

/// The opacity of a value per unit distance (picture.md 4), gradient opacity aside.
double opacityAt(const TransferFunction& curve, float value);

/// The curve as a classification table of `entries` >= 2 entries holds it, spread evenly over the range, the
/// nearest one looked up: steps half way between entries.
TransferFunction tabulated(const TransferFunction& curve, int entries, ValueRange range);

/// The curve with opacity 0 where it is below `opacity` (per unit distance); colours kept.
TransferFunction withoutFaint(const TransferFunction& curve, double opacity);

}  // namespace volumen
