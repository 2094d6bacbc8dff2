#pragma once

#include "viewer/scene/scene.h"

namespace volumen {

/// Edits of a curve. Results stay valid: ascending values, opacities 0..1, at least one point.

/// Returns the curve's colour and opacity at a value (picture.md 4, without gradient opacity).
CurvePoint curveAt(const TransferFunction& curve, double value);

/// Moves point `n`, but not past its neighbours.
TransferFunction withPointMoved(TransferFunction curve, int n, double value, double opacity);
/// Adds a point with the curve's colour there; *n receives its index.
TransferFunction withPointAdded(TransferFunction curve, double value, double opacity, int* n);
/// Removes point `n`; the only remaining point stays.
TransferFunction withPointRemoved(TransferFunction curve, int n);

/// Shifts all points by `values`.
TransferFunction shifted(TransferFunction curve, double values);
/// Scales distances between points by `factor` > 0 around the middle of the curve.
TransferFunction widened(TransferFunction curve, double factor);
/// Multiplies every extinction by `factor` >= 0; opacities 0 and 1 stay.
TransferFunction withOpacityScaled(TransferFunction curve, double factor);

}  // namespace volumen
