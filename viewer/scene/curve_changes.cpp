#include "viewer/scene/curve_changes.h"

#include <algorithm>

namespace volumen {

namespace {

// Interpolates between two points at fraction s.
CurvePoint between(const CurvePoint& a, const CurvePoint& b, double s) {
  return {float(double(a.value) + s * (double(b.value) - a.value)), a.colour + s * (b.colour - a.colour),
          a.opacity + s * (b.opacity - a.opacity)};
}

// The last of equal points holds at their value (picture.md 4).
CurvePoint curveAt(const std::vector<CurvePoint>& points, float value) {
  const auto behind = std::upper_bound(points.begin(), points.end(), value,
                                       [](float v, const CurvePoint& p) { return v < p.value; });
  CurvePoint found =
      behind == points.begin() ? *behind
      : behind == points.end()
          ? points.back()
          : between(behind[-1], *behind,
                    (double(value) - behind[-1].value) / (double(behind->value) - behind[-1].value));
  found.value = value;
  return found;
}

}  // namespace

double opacityAt(const TransferFunction& curve, float value) { return curveAt(curve.points, value).opacity; }

TransferFunction tabulated(const TransferFunction& curve, int entries, ValueRange range) {
  TransferFunction out = curve;
  const double width = (range.high - range.low) / (entries - 1);
  const auto entry = [&](int n) { return curveAt(curve.points, float(range.low + n * width)); };
  CurvePoint last = entry(0);
  out.points = {last};
  for (int n = 1; n < entries; ++n) {
    CurvePoint next = entry(n);
    if (next.colour == last.colour && next.opacity == last.opacity) continue;
    last.value = next.value = float(range.low + (n - 0.5) * width);
    out.points.push_back(last);
    out.points.push_back(next);
    last = next;
  }
  return out;
}

TransferFunction withoutFaint(const TransferFunction& curve, double opacity) {
  TransferFunction out = curve;
  out.points.clear();
  const auto shown = [&](CurvePoint p, bool faint) {
    if (faint) p.opacity = 0;
    out.points.push_back(p);
  };
  for (std::size_t n = 0; n < curve.points.size(); ++n) {
    const CurvePoint& here = curve.points[n];
    const bool faint = here.opacity < opacity;
    if (n > 0 && here.value > curve.points[n - 1].value) {
      const CurvePoint& before = curve.points[n - 1];
      const bool wasFaint = before.opacity < opacity;
      if (faint != wasFaint) {
        const CurvePoint edge =
            between(before, here, (opacity - before.opacity) / (here.opacity - before.opacity));
        shown(edge, wasFaint);
        shown(edge, faint);
      }
    }
    shown(here, faint);
  }
  return out;
}

}  // namespace volumen
