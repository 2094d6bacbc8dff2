#include "ui/widgets/axes.h"

#include <algorithm>
#include <cmath>

namespace volumen {

namespace {
const double largestOpacity = 1 - std::ldexp(1.0, -20);
}

double extinctionPerMm(double opacity, double unitDistance) {
  return -std::log1p(-std::min(opacity, largestOpacity)) / unitDistance;
}

double opacityFromExtinction(double extinction, double unitDistance) {
  const double opacity = -std::expm1(-extinction * unitDistance);
  return opacity >= largestOpacity ? 1.0 : std::max(0.0, opacity);
}

std::vector<double> roundTicks(double low, double high, int most) {
  std::vector<double> ticks;
  if (!(high > low) || most < 1) return ticks;
  const double least = (high - low) / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10 * power;
  for (double factor : {1.0, 2.0, 5.0}) {
    if (factor * power < least) continue;
    step = factor * power;
    break;
  }
  const double first = std::ceil(low / step), last = std::floor(high / step);
  for (double n = first; n <= last && int(ticks.size()) < most; ++n) ticks.push_back(n * step);
  return ticks;
}

double ValueAxis::pixelOf(double value) const { return pixelLow + (value - low) / valuesPerPixel(); }

double ValueAxis::valueAt(double pixel) const { return low + (pixel - pixelLow) * valuesPerPixel(); }

ValueAxis ValueAxis::zoomedAt(double pixel, double factor) const {
  const double fixed = valueAt(pixel);
  ValueAxis axis = *this;
  axis.low = fixed + (low - fixed) * factor;
  axis.high = fixed + (high - fixed) * factor;
  return axis;
}

ValueAxis ValueAxis::panned(double pixels) const {
  ValueAxis axis = *this;
  axis.low -= pixels * valuesPerPixel();
  axis.high -= pixels * valuesPerPixel();
  return axis;
}

double OpacityAxis::pixelOf(double opacity) const {
  if (scale == OpacityScale::linear) return pixelZero + opacity * (pixelOne - pixelZero);
  const double extinction = extinctionPerMm(opacity, unitDistance);
  if (extinction < lowestExtinction) return pixelZero;
  const double lowest = pixelZero - zeroStripPixels;
  const double decades = std::log10(extinctionPerMm(1, unitDistance) / lowestExtinction);
  return lowest + std::log10(extinction / lowestExtinction) / decades * (pixelOne - lowest);
}

double OpacityAxis::opacityAt(double pixel) const {
  if (scale == OpacityScale::linear)
    return std::clamp((pixel - pixelZero) / (pixelOne - pixelZero), 0.0, 1.0);
  const double lowest = pixelZero - zeroStripPixels;
  if (pixel > lowest + zeroStripPixels / 2) return 0;
  const double decades = std::log10(extinctionPerMm(1, unitDistance) / lowestExtinction);
  const double along = std::clamp((pixel - lowest) / (pixelOne - lowest), 0.0, 1.0);
  return opacityFromExtinction(lowestExtinction * std::pow(10.0, along * decades), unitDistance);
}

std::vector<double> OpacityAxis::ticks() const {
  if (scale == OpacityScale::linear) return {0, 0.2, 0.4, 0.6, 0.8, 1};
  std::vector<double> opacities{0};
  const double highest = extinctionPerMm(1, unitDistance);
  for (double extinction = lowestExtinction; extinction <= highest; extinction *= 10)
    opacities.push_back(opacityFromExtinction(extinction, unitDistance));
  return opacities;
}

}  // namespace volumen
