#pragma once

#include <QRectF>
#include <optional>
#include <vector>

namespace volumen {

/// Places labels beside points without overlap of points or labels.
class LabelPlaces {
 public:
  /// Labels stay inside `area`.
  explicit LabelPlaces(const QRectF& area) : area_(area) {}

  /// Keeps an area free of labels.
  void take(const QRectF& taken) { taken_.push_back(taken); }

  /// Reserves and returns a place for a label near a point: the first free one, nearest first, to the right,
  /// left, above, below or diagonal. Empty if there is none.
  std::optional<QRectF> place(const QPointF& point, const QSizeF& size);

 private:
  bool isFree(const QRectF& place) const;
  QRectF area_;
  std::vector<QRectF> taken_;
};

}  // namespace volumen
