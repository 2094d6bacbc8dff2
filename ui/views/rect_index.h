#pragma once

#include <QRectF>
#include <algorithm>
#include <vector>

namespace volumen {

/// A grid of rectangles, so that a test for intersection looks at nearby rectangles only.
class RectIndex {
 public:
  /// `area` should contain most rectangles.
  explicit RectIndex(const QRectF& area)
      : origin_(area.topLeft()),
        columns_(std::clamp(int(area.width() / cell) + 1, 1, mostCells)),
        rows_(std::clamp(int(area.height() / cell) + 1, 1, mostCells)),
        cells_(std::size_t(columns_) * std::size_t(rows_)) {}

  /// Adds a rectangle that stands for `item`.
  void add(const QRectF& rect, std::size_t item) {
    forCells(rect, [&](std::vector<Entry>& entries) {
      entries.push_back({rect, item});
      return false;
    });
  }

  /// Returns whether a rectangle intersects `rect` and `is(item)` holds for its item.
  template <class Is>
  bool any(const QRectF& rect, const Is& is) const {
    return forCells(rect, [&](const std::vector<Entry>& entries) {
      return std::ranges::any_of(
          entries, [&](const Entry& entry) { return entry.rect.intersects(rect) && is(entry.item); });
    });
  }
  bool any(const QRectF& rect) const {
    return any(rect, [](std::size_t) { return true; });
  }

 private:
  static constexpr double cell = 64;  // logical pixels
  static constexpr int mostCells = 256;

  struct Entry {
    QRectF rect;
    std::size_t item = 0;
  };

  // Rectangles outside the area belong to the cells at its edge.
  static int cellOf(double offset, int count) {
    return int(std::max(0.0, std::min(count - 1.0, offset / cell)));  // in this order for NaN, too
  }

  template <class Visit>
  static bool visit(auto& index, const QRectF& rect, const Visit& each) {
    const int left = cellOf(rect.left() - index.origin_.x(), index.columns_),
              right = cellOf(rect.right() - index.origin_.x(), index.columns_),
              top = cellOf(rect.top() - index.origin_.y(), index.rows_),
              bottom = cellOf(rect.bottom() - index.origin_.y(), index.rows_);
    for (int row = top; row <= bottom; ++row)
      for (int column = left; column <= right; ++column)
        if (each(index.cells_[std::size_t(row * index.columns_ + column)])) return true;
    return false;
  }
  template <class Visit>
  bool forCells(const QRectF& rect, const Visit& each) {
    return visit(*this, rect, each);
  }
  template <class Visit>
  bool forCells(const QRectF& rect, const Visit& each) const {
    return visit(*this, rect, each);
  }

  QPointF origin_;
  int columns_, rows_;
  std::vector<std::vector<Entry>> cells_;  // row by row
};

}  // namespace volumen
