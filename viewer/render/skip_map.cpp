#include "viewer/render/skip_map.h"

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Every entry takes in its next neighbour along an axis.
void takeInNext(std::vector<std::uint8_t>& values, glm::ivec3 count, int axis) {
  const std::size_t row = count.x, slice = row * count.y;
  if (axis == 2) {
    for (std::size_t n = 0; n + slice < values.size(); ++n) values[n] |= values[n + slice];
    return;
  }
  parallelFor(count.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) {
      std::uint8_t* v = values.data() + k * slice;
      if (axis == 1)
        for (std::size_t n = 0; n + row < slice; ++n) v[n] |= v[n + row];
      else
        for (std::size_t start = 0; start < slice; start += row)
          for (std::size_t n = start; n + 1 < start + row; ++n) v[n] |= v[n + 1];
    }
  });
}

}  // namespace

SkipMap makeSkipMap(glm::ivec3 count, std::vector<std::uint8_t> visible, int reach) {
  const auto takeIn = [&](std::vector<std::uint8_t>& values) {
    for (int axis = 0; axis < 3; ++axis) takeInNext(values, count, axis);
  };
  std::vector<std::uint8_t> tight = visible;
  for (int n = 0; n < reach - 1; ++n) takeIn(tight);
  std::vector<std::uint8_t> wide = tight;
  takeIn(wide);
  tight.insert(tight.end(), wide.begin(), wide.end());
  tight.resize(tight.size() + 4);
  visible.resize(visible.size() + 4);
  return {count, std::move(visible), std::move(tight), reach};
}

}  // namespace volumen
