#pragma once

#include <vector>

namespace volumen {

/// Returns the extinction per mm of an opacity per `unitDistance` mm (picture.md 4).
double extinctionPerMm(double opacity, double unitDistance);
/// The inverse; the extinction of opacity 1 - 2^-20 or more gives 1.
double opacityFromExtinction(double extinctionPerMm, double unitDistance);

/// Returns round numbers (1, 2 or 5 times a power of ten apart) between low and high, at most `most`.
std::vector<double> roundTicks(double low, double high, int most);

/// Linear mapping between values and horizontal pixels.
struct ValueAxis {
  double low = 0, high = 1;              ///< values at the ends
  double pixelLow = 0, pixelHigh = 100;  ///< x of the ends

  double pixelOf(double value) const;
  double valueAt(double pixel) const;
  double valuesPerPixel() const { return (high - low) / (pixelHigh - pixelLow); }
  /// Returns the axis with `factor` times as many values in view; the value under `pixel` stays.
  ValueAxis zoomedAt(double pixel, double factor) const;
  /// Returns the axis after a drag by `pixels` to the right.
  ValueAxis panned(double pixels) const;
};

enum class OpacityScale {
  linear,     ///< opacity 0..1
  extinction  ///< logarithm of the extinction per mm, above a strip for 0
};

/// Mapping between opacities (per unitDistance mm) and vertical pixels.
struct OpacityAxis {
  OpacityScale scale = OpacityScale::linear;
  double unitDistance = 1;
  double pixelZero = 100, pixelOne = 0;  ///< y of opacity 0 and 1

  static constexpr double lowestExtinction = 1e-5;  ///< per mm; smaller values are in the strip for 0
  static constexpr double zeroStripPixels = 10;

  double pixelOf(double opacity) const;
  double opacityAt(double pixel) const;
  /// Returns labelled opacities: tenths and fifths, or powers of ten of the extinction.
  std::vector<double> ticks() const;
};

}  // namespace volumen
