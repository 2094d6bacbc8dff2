#pragma once

#include <QRectF>
#include <utility>
#include <vector>

#include "ui/workspace/flat_plane.h"

class QPainter;

namespace volumen {

/// The bar at the right of a stack, from its first place at the top to its last: where one is, the key
/// images, and what is in memory. Logical pixels.
struct StackBar {
  static constexpr int edge = 10;  ///< how wide it can be pressed

  QRectF area;
  StackPlace place;
  std::vector<int> keyImages{};             ///< places
  std::vector<std::pair<int, int>> held{};  ///< from the first to the last place of each run in memory
  bool isThick = false;                     ///< the pointer is on it

  /// Which place is at a height; the nearest one beyond the ends.
  int placeAt(double y) const;
  /// What of the height is a place's.
  QRectF partOf(int first, int last) const;
  void paint(QPainter& painter) const;
};

/// Runs of numbers that follow each other; `numbers`: ascending.
std::vector<std::pair<int, int>> runsOf(const std::vector<int>& numbers);

}  // namespace volumen
