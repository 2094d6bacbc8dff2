#pragma once

#include "viewer/scene/scene.h"

namespace volumen {

/// Edits of a curve, from value to value. Results stay valid: values in order, opacities 0..1, one point or
/// more.

/// The curve's own colour and opacity at a value (picture.md 4, without gradient opacity).
CurvePoint curveAt(const TransferFunction& curve, double value);

/// Point `n` moved, not past its neighbours.
TransferFunction withPointMoved(TransferFunction curve, int n, double value, double opacity);
/// A new point with the curve's colour there; its index in *n.
TransferFunction withPointAdded(TransferFunction curve, double value, double opacity, int* n);
/// Without point `n`; the last point stays.
TransferFunction withPointRemoved(TransferFunction curve, int n);

/// All values moved by `values`.
TransferFunction shifted(TransferFunction curve, double values);
/// Distances between points stretched by `factor` > 0 about the middle of the curve.
TransferFunction widened(TransferFunction curve, double factor);
/// Every extinction times `factor` >= 0: opacity 0 and 1 stay.
TransferFunction withOpacityScaled(TransferFunction curve, double factor);

}  // namespace volumen
