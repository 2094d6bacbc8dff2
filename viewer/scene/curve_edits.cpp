#include "viewer/scene/curve_edits.h"

#include <algorithm>
#include <cmath>

namespace volumen {

CurvePoint curveAt(const TransferFunction& curve, double value) {
  const auto& points = curve.points;
  const auto above = std::upper_bound(points.begin(), points.end(), value,
                                      [](double v, const CurvePoint& p) { return v < double(p.value); });
  CurvePoint at = above == points.begin() ? points.front() : *(above - 1);
  if (above != points.begin() && above != points.end()) {
    const CurvePoint& a = *(above - 1);
    const double t = (value - a.value) / (double(above->value) - a.value);
    at.colour = a.colour + t * (above->colour - a.colour);
    at.opacity = a.opacity + t * (above->opacity - a.opacity);
  }
  at.value = float(value);
  return at;
}

TransferFunction withPointMoved(TransferFunction curve, int n, double value, double opacity) {
  auto& points = curve.points;
  float moved = float(value);
  if (n > 0) moved = std::max(moved, points[n - 1].value);
  if (n + 1 < int(points.size())) moved = std::min(moved, points[n + 1].value);
  points[n].value = moved;
  points[n].opacity = std::clamp(opacity, 0.0, 1.0);
  return curve;
}

TransferFunction withPointAdded(TransferFunction curve, double value, double opacity, int* n) {
  CurvePoint added = curveAt(curve, value);
  added.opacity = std::clamp(opacity, 0.0, 1.0);
  const auto above = std::upper_bound(curve.points.begin(), curve.points.end(), added.value,
                                      [](float v, const CurvePoint& p) { return v < p.value; });
  *n = int(above - curve.points.begin());
  curve.points.insert(above, added);
  return curve;
}

TransferFunction withPointRemoved(TransferFunction curve, int n) {
  if (curve.points.size() > 1) curve.points.erase(curve.points.begin() + n);
  return curve;
}

TransferFunction shifted(TransferFunction curve, double values) {
  for (CurvePoint& p : curve.points) p.value = float(p.value + values);
  return curve;
}

TransferFunction widened(TransferFunction curve, double factor) {
  const double middle = (double(curve.points.front().value) + curve.points.back().value) / 2;
  for (CurvePoint& p : curve.points) p.value = float(middle + (p.value - middle) * factor);
  return curve;
}

TransferFunction withOpacityScaled(TransferFunction curve, double factor) {
  for (CurvePoint& p : curve.points)
    if (p.opacity < 1) p.opacity = std::clamp(-std::expm1(std::log1p(-p.opacity) * factor), 0.0, 1.0);
  return curve;
}

}  // namespace volumen
