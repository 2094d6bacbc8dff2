#include "viewer/segment/distance_field.h"

#include <cmath>
#include <limits>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr double farAway = std::numeric_limits<double>::infinity();

// The lower envelope of parabolas, one at each place of a line (Felzenszwalb and Huttenlocher, Distance
// Transforms of Sampled Functions, 2012).
class Envelope {
 public:
  explicit Envelope(int places)
      : heights_(std::size_t(places)), tops_(std::size_t(places)), from_(std::size_t(places) + 1) {}

  // Replaces squared distances along one line by those to the nearest parabola.
  void apply(float* line, std::ptrdiff_t step, double spacing) {
    const int places = int(heights_.size());
    int last = -1;
    for (int n = 0; n < places; ++n) {
      const double height = line[n * step] / (spacing * spacing);
      heights_[std::size_t(n)] = height;
      if (std::isinf(height)) continue;
      double begin = -farAway;
      for (; last >= 0; --last) {
        begin = crossing(tops_[std::size_t(last)], n);
        if (begin > from_[std::size_t(last)]) break;
      }
      ++last;
      tops_[std::size_t(last)] = n;
      from_[std::size_t(last)] = last == 0 ? -farAway : begin;
    }
    if (last < 0) return;
    from_[std::size_t(last) + 1] = farAway;
    for (int n = 0, k = 0; n < places; ++n) {
      while (from_[std::size_t(k) + 1] < n) ++k;
      const int top = tops_[std::size_t(k)];
      line[n * step] = float(spacing * spacing * (double(n - top) * (n - top) + heights_[std::size_t(top)]));
    }
  }

 private:
  double crossing(int a, int b) const {
    const double heightA = heights_[std::size_t(a)] + double(a) * a,
                 heightB = heights_[std::size_t(b)] + double(b) * b;
    return (heightB - heightA) / (2.0 * (b - a));
  }

  std::vector<double> heights_;
  std::vector<int> tops_;
  std::vector<double> from_;
};

}  // namespace

std::vector<float> distancesFrom(const BitMask& mask) {
  const glm::ivec3 size = mask.size();
  const glm::dvec3 spacing = mask.geometry().spacing();
  std::vector<float> field(std::size_t(mask.geometry().voxelCount()), std::numeric_limits<float>::infinity());
  const std::ptrdiff_t step[] = {1, size.x, std::ptrdiff_t(size.x) * size.y};
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i)
        if (mask.at({i, j, k})) field[std::size_t(i + j * step[1] + k * step[2])] = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    parallelFor(std::int64_t(size[a]) * size[b], 0, [&](std::int64_t begin, std::int64_t end) {
      Envelope envelope(size[axis]);
      for (std::int64_t n = begin; n < end; ++n)
        envelope.apply(field.data() + n % size[a] * step[a] + n / size[a] * step[b], step[axis],
                       spacing[axis]);
    });
  }
  for (float& squared : field) squared = std::sqrt(squared);
  return field;
}

}  // namespace volumen
