#include "results/plots/labels.h"

#include <algorithm>

namespace volumen {

bool LabelPlaces::isFree(const QRectF& place) const {
  return area_.contains(place) &&
         std::none_of(taken_.begin(), taken_.end(), [&](const QRectF& t) { return t.intersects(place); });
}

std::optional<QRectF> LabelPlaces::place(const QPointF& point, const QSizeF& size) {
  constexpr QPointF ways[] = {{1, 0}, {1, -1}, {0, -1}, {-1, 0}, {0, 1}, {1, 1}, {-1, -1}, {-1, 1}};
  for (const double distance : {8., 14., 24., 38.})
    for (const QPointF& way : ways) {
      // Puts the nearest edge or corner `distance` away from the point.
      const QPointF middle(point.x() + way.x() * (distance + size.width() / 2),
                           point.y() + way.y() * (distance * 0.6 + size.height() / 2));
      const QRectF at(middle.x() - size.width() / 2, middle.y() - size.height() / 2, size.width(),
                      size.height());
      if (!isFree(at)) continue;
      take(at);
      return at;
    }
  return {};
}

}  // namespace volumen
