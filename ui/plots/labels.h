#pragma once

#include <QRectF>
#include <optional>
#include <vector>

namespace volumen {

/// Finds places for labels beside points, so that they touch neither points nor each other.
class LabelPlaces {
 public:
  /// Labels stay inside `area`.
  explicit LabelPlaces(const QRectF& area) : area_(area) {}

  /// Nothing may be written here.
  void take(const QRectF& taken) { taken_.push_back(taken); }

  /// A place for a label of this size near a point, taken from now on: the first that is free of those right,
  /// left, above, below and across, near first. None where all are taken.
  std::optional<QRectF> place(const QPointF& point, const QSizeF& size);

 private:
  bool isFree(const QRectF& place) const;
  QRectF area_;
  std::vector<QRectF> taken_;
};

}  // namespace volumen
