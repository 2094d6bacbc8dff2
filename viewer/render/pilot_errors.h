#pragma once

#include <vector>

namespace volumen {

/// What a sample of a picture's tiles tells of the errors of all of it, at worst: of what it cannot have
/// missed but for one time in twenty.
class PilotErrors {
 public:
  /// The pixels that follow are of a tile that was to be looked at with that chance.
  void beginTile(double chance);
  /// A pixel that shows something: its largest component's error, 1/255, and the mean square of all four.
  void add(double largest, double square);

  struct Bounds {
    double rmse = 0, percentile99 = 0;  ///< 1/255
  };
  Bounds likely() const;  ///< as if all tiles were like these
  Bounds worst() const;
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
  /// Above that not more than a hundredth of the pixels lie, with so many standard deviations on top.
  double percentile99(double deviations) const;

  std::vector<Tile> tiles_;
  std::vector<Pixel> pixels_;
};

}  // namespace volumen
