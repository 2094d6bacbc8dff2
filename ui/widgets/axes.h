#pragma once

#include <vector>

namespace volumen {

/// Extinction per mm of an opacity per unitDistance mm (picture.md 4).
double extinctionPerMm(double opacity, double unitDistance);
/// Its inverse; an extinction of opacity 1 - 2^-20 and above gives 1.
double opacityFromExtinction(double extinctionPerMm, double unitDistance);

/// Round numbers (1, 2 or 5 times a power of ten apart) between low and high, at most `most` of them.
std::vector<double> roundTicks(double low, double high, int most);

/// Straight mapping between real values and horizontal pixels.
struct ValueAxis {
  double low = 0, high = 1;              ///< values at the ends
  double pixelLow = 0, pixelHigh = 100;  ///< x of the ends

  double pixelOf(double value) const;
  double valueAt(double pixel) const;
  double valuesPerPixel() const { return (high - low) / (pixelHigh - pixelLow); }
  /// The axis with `factor` as many values in view, the value under `pixel` staying there.
  ValueAxis zoomedAt(double pixel, double factor) const;
  /// The axis after its ground was dragged by `pixels` to the right.
  ValueAxis panned(double pixels) const;
};

enum class OpacityScale {
  linear,     ///< opacity 0..1
  extinction  ///< logarithm of the extinction per mm, with a strip for 0 below
};

/// Mapping between opacities (per unitDistance mm) and vertical pixels.
struct OpacityAxis {
  OpacityScale scale = OpacityScale::linear;
  double unitDistance = 1;
  double pixelZero = 100, pixelOne = 0;  ///< y of opacity 0 and of opacity 1

  static constexpr double lowestExtinction = 1e-5;  ///< per mm; below is the strip for 0
  static constexpr double zeroStripPixels = 10;

  double pixelOf(double opacity) const;
  double opacityAt(double pixel) const;
  /// Opacities worth a line and a number: tenths and fifths, or powers of ten of the extinction.
  std::vector<double> ticks() const;
};

}  // namespace volumen
