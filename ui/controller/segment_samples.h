#pragma once

#include <QRect>
#include <bitset>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "ui/controller/segment_layer.h"

namespace volumen {

/// Samples the visible segments in an area of a picture. A sample is a position in the layer's list, from 1;
/// 0 is none. A pixel has five sample points: its centre and four about it, on a rotated square grid that
/// continues across pixels. If voxels are smaller than pixels, each part of a pixel has five.
class SegmentSamples {
 public:
  /// Samples a label map (LabelReader). Uses all cores.
  static SegmentSamples ofLabels(const SegmentLayer& layer, const SlicePlane& plane);
  /// Samples one segment of a segmentation, which becomes number 1. Uses all cores.
  static SegmentSamples ofSegmentation(const Segmentation& all, std::size_t segment, const SlicePlane& plane);

  /// Returns the pixels that contain all visible segments, with a margin of one pixel. Empty if nothing is
  /// visible.
  const QRect& area() const { return area_; }
  /// Returns the number of sample points per pixel, at most 1280.
  int places() const { return placesOfPart * parts_.x * parts_.y; }

  /// Width in pixels of the tiles of each row; the last one is narrower.
  static constexpr int tileWidth = 32;
  int tiles() const { return (area_.width() + tileWidth - 1) / tileWidth; }
  /// Set of the numbers, including 0, that occur in a tile of a row of the area, from 0.
  using Numbers = std::bitset<256>;
  const Numbers& numbersIn(int row, int tile) const {
    return met_[std::size_t(row) * std::size_t(tiles()) + std::size_t(tile)];
  }
  /// Writes the number of sample points in a segment for pixels [from, to) of a row of the area.
  void count(int row, std::size_t number, int from, int to, std::uint16_t* counts) const;

 private:
  static constexpr int placesOfPart = 5;
  /// Writes the numbers at a point of the picture, and at points a given number of pixels apart to its right.
  using ReadLine = std::function<void(glm::dvec2, double, std::span<std::uint8_t>)>;

  SegmentSamples(std::span<const glm::dvec3> corners, const SlicePlane& plane, glm::dvec2 voxelsPerPixel,
                 std::size_t shownCount, const ReadLine& readLine);
  void readRow(int row, const ReadLine& readLine);
  void noteNumbers(int row);
  std::size_t lineLength() const { return std::size_t(area_.width() * parts_.x); }
  /// The sample points of a row form lines.
  std::size_t linesOfRow() const { return std::size_t(placesOfPart * parts_.y); }
  std::span<std::uint8_t> line(int row, std::size_t n);
  std::span<const std::uint8_t> line(int row, std::size_t n) const;

  QRect area_;
  glm::ivec2 parts_;  // per pixel, in both directions
  std::size_t shownCount_;
  std::vector<std::uint8_t> numbers_;  // line by line
  std::vector<Numbers> met_;           // row by row
};

}  // namespace volumen
