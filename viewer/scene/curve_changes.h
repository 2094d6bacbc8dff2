#pragma once

#include "viewer/scene/scene.h"

namespace volumen {

/// Returns the opacity of a value per unit distance (picture.md 4), without gradient opacity.
double opacityAt(const TransferFunction& curve, float value);

/// Returns the curve as a table of `entries` >= 2 evenly spaced entries with nearest look-up, so it steps
/// halfway between entries.
TransferFunction tabulated(const TransferFunction& curve, int entries, ValueRange range);

/// Returns the curve with opacities below `opacity` (per unit distance) set to 0; colours are kept.
TransferFunction withoutFaint(const TransferFunction& curve, double opacity);

}  // namespace volumen
