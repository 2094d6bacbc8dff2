#pragma once

#include <vector>

namespace volumen {

/// Estimates the errors of a whole picture from a sample of its tiles, including a worst case that allows for
/// missed errors with 95 % confidence.
class PilotErrors {
 public:
  /// Starts a tile that was sampled with this probability; the following pixels belong to it.
  void beginTile(double chance);
  /// Adds a pixel that shows something: the error of its largest component in 1/255, and the mean square of
  /// all four.
  void add(double largest, double square);

  struct Bounds {
    double rmse = 0, percentile99 = 0;  ///< Errors in 1/255
  };
  Bounds likely() const;  ///< Estimate without a safety margin
  /// What is assumed of the tiles that were not chosen.
  struct Missed {
    double asWrong = 2;     ///< Factor from the worst tile found to a missed one
    double least = 0;       ///< Least error of a missed pixel, 1/255
    double deviations = 2;  ///< Margin of the 99th percentile, standard deviations
  };
  Bounds worst(const Missed& missed) const;
  int rays() const { return int(pixels_.size()); }

 private:
  struct Tile {
    double chance = 1, squares = 0;
    int pixels = 0;
  };
  struct Pixel {
    double largest = 0;
    int tile = 0;
  };
  double pixelsInAll() const;
  /// Returns the error that at most 1 % of the pixels exceed, plus `deviations` standard deviations.
  double percentile99(double deviations) const;

  std::vector<Tile> tiles_;
  std::vector<Pixel> pixels_;
};

}  // namespace volumen
