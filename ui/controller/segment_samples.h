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

/// Which of the shown segments the places of each pixel of a part of a picture are in: their numbers in the
/// layer's list, from 1; 0: none. A pixel has five places, its centre and four about it on a turned square
/// grid that goes on through all pixels; where voxels are smaller than pixels, each of its parts has them.
class SegmentSamples {
 public:
  /// Of a label map (LabelReader). On all cores.
  static SegmentSamples ofLabels(const SegmentLayer& layer, const SlicePlane& plane);
  /// Of one segment of a segmentation, which is number 1. On all cores.
  static SegmentSamples ofSegmentation(const Segmentation& all, std::size_t segment, const SlicePlane& plane);

  /// The pixels that have all that is shown, and those beside them. Empty where nothing is.
  const QRect& area() const { return area_; }
  /// How many places a pixel has, at most 1280.
  int places() const { return placesOfPart * parts_.x * parts_.y; }

  /// Rows of the area are cut into tiles of so many pixels, the last one shorter.
  static constexpr int tileWidth = 32;
  int tiles() const { return (area_.width() + tileWidth - 1) / tileWidth; }
  /// Which numbers, 0 too, are met in a tile of a row of the area, from 0.
  using Numbers = std::bitset<256>;
  const Numbers& numbersIn(int row, int tile) const {
    return met_[std::size_t(row) * std::size_t(tiles()) + std::size_t(tile)];
  }
  /// Writes how many places of the pixels [from, to) of a row of the area are in a segment.
  void count(int row, std::size_t number, int from, int to, std::uint16_t* counts) const;

 private:
  static constexpr int placesOfPart = 5;
  /// Writes the numbers at a place of the picture, and at places each so many pixels right of the one before.
  using ReadLine = std::function<void(glm::dvec2, double, std::span<std::uint8_t>)>;

  SegmentSamples(std::span<const glm::dvec3> corners, const SlicePlane& plane, glm::dvec2 voxelsPerPixel,
                 std::size_t shownCount, const ReadLine& readLine);
  void readRow(int row, const ReadLine& readLine);
  void noteNumbers(int row);
  std::size_t lineLength() const { return std::size_t(area_.width() * parts_.x); }
  /// The places of a row, line after line.
  std::size_t linesOfRow() const { return std::size_t(placesOfPart * parts_.y); }
  std::span<std::uint8_t> line(int row, std::size_t n);
  std::span<const std::uint8_t> line(int row, std::size_t n) const;

  QRect area_;
  glm::ivec2 parts_;  // of a pixel, along its sides
  std::size_t shownCount_;
  std::vector<std::uint8_t> numbers_;  // line by line
  std::vector<Numbers> met_;           // row by row
};

}  // namespace volumen
