#include <algorithm>
#include <cmath>

#include "viewer/volume/float_units.h"
#include "viewer/volume/gradients.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Weights of the difference of two neighbours along an axis: on the axis, one step off it, two steps off it
// (corners of the 3 x 3 x 3 neighbours). face + 4 edge + 4 corner = 1/2.
struct Weights {
  float face, edge, corner;
};

Weights weightsOf(GradientOperator by) {
  if (by == GradientOperator::central) return {0.5f, 0, 0};
  if (by == GradientOperator::sobel) return {4 / 32.0f, 2 / 32.0f, 1 / 32.0f};
  // Zucker and Hummel (1981) weight neighbours by inverse distance.
  const double edge = 1 / std::sqrt(2.0), corner = 1 / std::sqrt(3.0), sum = 1 + 4 * edge + 4 * corner;
  return {float(0.5 / sum), float(0.5 * edge / sum), float(0.5 * corner / sum)};
}

// Sums over the 3 x 3 neighbours across x, one entry per voxel and one more at each end (clamped).
struct Sums {
  explicit Sums(std::size_t voxels) : across(voxels + 2), y(voxels + 2), ySide(y), z(y), zSide(y) {}
  void clampEnds() {
    for (auto* s : {&across, &y, &ySide, &z, &zSide})
      s->front() = *(s->begin() + 1), s->back() = *(s->end() - 2);
  }
  std::vector<float> across, y, ySide, z, zSide;
};

template <class T>
void sumAcross(const T* const (&r)[3][3], std::size_t count, Weights w, Sums& s) {
  for (std::size_t n = 0; n < count; ++n) {
    const auto at = [&](int z, int y) { return float(r[z][y][n]); };
    const float corners = (at(0, 0) + at(0, 2)) + (at(2, 0) + at(2, 2));
    const float edges = (at(0, 1) + at(2, 1)) + (at(1, 0) + at(1, 2));
    s.across[n + 1] = w.face * at(1, 1) + w.edge * edges + w.corner * corners;
    const float y = at(1, 2) - at(1, 0), yOff = (at(0, 2) - at(0, 0)) + (at(2, 2) - at(2, 0));
    const float z = at(2, 1) - at(0, 1), zOff = (at(2, 0) - at(0, 0)) + (at(2, 2) - at(0, 2));
    s.y[n + 1] = w.face * y + w.edge * yOff, s.ySide[n + 1] = w.edge * y + w.corner * yOff;
    s.z[n + 1] = w.face * z + w.edge * zOff, s.zSide[n + 1] = w.edge * z + w.corner * zOff;
  }
  s.clampEnds();
}

// Calls use(first voxel, sums) for every row.
template <class T, class Use>
void overRows(const std::vector<T>& stored, glm::ivec3 size, GradientOperator by, const Use& use) {
  const Weights weights = weightsOf(by);
  parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    const std::size_t count = std::size_t(size.x);
    Sums s(count);
    for (std::int64_t row = begin; row < end; ++row) {
      const T* rows[3][3];
      for (int dz = 0; dz < 3; ++dz)
        for (int dy = 0; dy < 3; ++dy) {
          const std::int64_t y = std::clamp<std::int64_t>(row % size.y + dy - 1, 0, size.y - 1),
                             z = std::clamp<std::int64_t>(row / size.y + dz - 1, 0, size.z - 1);
          rows[dz][dy] = stored.data() + (z * size.y + y) * size.x;
        }
      sumAcross(rows, count, weights, s);
      use(std::size_t(row) * count, s);
    }
  });
}

// Calls store(voxel, x, y, z) for every voxel of a row, with gradients in stored values per voxel.
template <class Store>
void overVoxels(const Sums& s, std::size_t count, const Store& store) {
  for (std::size_t n = 0; n < count; ++n)
    store(n, s.across[n + 2] - s.across[n], s.y[n + 1] + (s.ySide[n] + s.ySide[n + 2]),
          s.z[n + 1] + (s.zSide[n] + s.zSide[n + 2]));
}

// Writes a row as x, y, z, 0.
void writeRow32(const Sums& s, std::size_t count, float sign, float* out) {
  overVoxels(s, count, [=](std::size_t n, float x, float y, float z) {
    float* to = out + 4 * n;
    to[0] = sign * x, to[1] = sign * y, to[2] = sign * z, to[3] = 0;
  });
}

}  // namespace

Gradients16 gradients16By(const Volume& volume, GradientOperator by) {
  if (by == GradientOperator::sobel) return sobel16(volume);
  const ValueRange range = valueRange(volume);
  // Components are at most half the range. The unit is a power of two, at least 1/32, as for Sobel.
  const double largest = (range.high - range.low) / 2 / std::abs(volume.slope());
  double unit = 1.0 / 32;
  while (largest / unit > 32767) unit *= 2;
  Gradients16 g = makeGradients16(volume.size(), volume.slope() * unit);
  const float perUnit = float(1 / unit);
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        const int shift = std::is_same_v<T, std::uint16_t> ? 32768 : 0;
        const auto packed = [&](float v) { return std::int16_t(std::lrint(v * perUnit)); };
        const std::size_t count = std::size_t(volume.size().x);
        overRows(stored, volume.size(), by, [&](std::size_t first, const Sums& s) {
          std::int16_t* const row = g.row(first / count);
          overVoxels(s, count, [&](std::size_t n, float x, float y, float z) {
            std::int16_t* to = row + 4 * n;
            to[0] = packed(x), to[1] = packed(y), to[2] = packed(z),
            to[3] = std::int16_t(int(stored[first + n]) - shift);
          });
        });
      },
      volume.stored());
  return g;
}

Gradients32 gradients32By(const Volume& volume, GradientOperator by) {
  if (by == GradientOperator::sobel) return sobel32(volume);
  Gradients32 g{Buffer<float>(std::size_t(4) * volume.geometry().voxelCount())};
  g.scale = withFloatUnits(volume, [&](const auto& samples, float sign) {
    overRows(samples, volume.size(), by, [&](std::size_t first, const Sums& s) {
      writeRow32(s, std::size_t(volume.size().x), sign, g.xyz0.data() + 4 * first);
    });
  });
  return g;
}

double gradientRowsBy(const Volume& volume, GradientOperator by, const UseGradientRow& use) {
  if (by == GradientOperator::sobel) return sobelRows(volume, use);
  const std::size_t count = std::size_t(volume.size().x);
  return withFloatUnits(volume, [&](const auto& samples, float sign) {
    overRows(samples, volume.size(), by, [&](std::size_t first, const Sums& s) {
      std::vector<float> xyz0(4 * count);
      writeRow32(s, count, sign, xyz0.data());
      use(first, xyz0.data());
    });
  });
}

}  // namespace volumen
