#pragma once

#include <glm/vec4.hpp>
#include <vector>

namespace volumen {

/// Estimates how far the means over blocks of pixels are off in a whole picture, from a sample of its blocks.
class BlockErrors {
 public:
  /// `components`: how many of the four can differ (componentsThatDiffer).
  explicit BlockErrors(int components) : components_(components) {}

  /// Starts a block that was sampled with this probability; the following pixels belong to it.
  void beginBlock(double chance);
  /// Adds the difference of a pixel, 1/255, and whether it shows anything.
  void add(const glm::dvec4& off, bool shows);
  /// Returns the number of pixels that show anything.
  int shown() const { return shown_; }

  struct Bounds {
    double rmse = 0;         ///< Of means over blocks, 1/255
    double meanColour = 0;   ///< Largest component of the mean difference, 1/255
    double rmseOfShown = 0;  ///< Of single pixels that show anything, 1/255; without a margin
  };
  /// Returns the estimate plus two standard deviations.
  Bounds worst() const;

 private:
  struct Block {
    double weight = 0;
    glm::dvec4 sum{0};
    int pixels = 0;
  };
  int components_, shown_ = 0;
  double shownInAll_ = 0, squaresOfShown_ = 0;  ///< Of the whole picture
  std::vector<Block> blocks_;
};

}  // namespace volumen
