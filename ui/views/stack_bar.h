#pragma once

#include <QRectF>
#include <utility>
#include <vector>

#include "ui/workspace/flat_plane.h"

class QPainter;

namespace volumen {

/// The bar at the right of a stack, with its first position at the top. It shows the current position, key
/// images, and what is in memory. Logical pixels.
struct StackBar {
  static constexpr int edge = 10;  ///< width that reacts to presses

  QRectF area;
  StackPlace place;
  std::vector<int> keyImages{};             ///< positions
  std::vector<std::pair<int, int>> held{};  ///< first and last position of each run in memory
  bool isThick = false;                     ///< whether the pointer is on the bar

  /// Returns the position at a height; outside the bar the nearest one.
  int placeAt(double y) const;
  /// Returns the part of the bar for positions `first` to `last`.
  QRectF partOf(int first, int last) const;
  void paint(QPainter& painter) const;
};

/// Returns runs of consecutive numbers. `numbers` is ascending.
std::vector<std::pair<int, int>> runsOf(const std::vector<int>& numbers);

}  // namespace volumen
