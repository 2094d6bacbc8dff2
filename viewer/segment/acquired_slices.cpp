#include "viewer/segment/acquired_slices.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "viewer/volume/parallel.h"

namespace volumen {

BitMask onAcquired(const BitMask& mask, const AcquiredSlices& slices) {
  BitMask placed(slices.volume->geometry());
  parallelFor(placed.size().z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t slice = begin; slice < end; ++slice) {
      const double k = std::floor(slices.places[std::size_t(slice)] + 0.5);
      const int nearest = int(std::clamp(k, 0.0, mask.size().z - 1.0));
      for (int j = 0; j < placed.size().y; ++j)
        std::ranges::copy(mask.row(j, nearest), placed.row(j, int(slice)).begin());
    }
  });
  return placed;
}

BitMask fromAcquired(const BitMask& onSlices, const AcquiredSlices& slices, const VoxelGeometry& grid) {
  const std::vector<double>& places = slices.places;
  BitMask placed(grid);
  parallelFor(grid.size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) {
      const auto nearest =
          std::ranges::min_element(places, {}, [&](double place) { return std::abs(place - double(k)); });
      for (int j = 0; j < grid.size.y; ++j)
        std::ranges::copy(onSlices.row(j, int(nearest - places.begin())), placed.row(j, int(k)).begin());
    }
  });
  return placed;
}

std::vector<double> sharesOf(const std::vector<double>& places) {
  constexpr double beyondLast = 0.5;
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::sort(order, {}, [&](std::size_t n) { return places[n]; });
  std::vector<double> shares(places.size(), 0);
  const auto halfWay = [&](std::size_t n) { return (places[order[n + 1]] - places[order[n]]) / 2; };
  for (std::size_t n = 0; n < order.size(); ++n)
    shares[order[n]] =
        (n == 0 ? beyondLast : halfWay(n - 1)) + (n + 1 == order.size() ? beyondLast : halfWay(n));
  return shares;
}

}  // namespace volumen
