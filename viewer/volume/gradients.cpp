#include "viewer/volume/gradients.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/volume/gradients.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "viewer/volume/float_units.h"
#include "viewer/volume/gradient_bricks.h"
#include "viewer/volume/parallel.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The nine rows around a row of voxels: rows[z][y] with 0 before, 1 at, 2 behind; clamped at the faces.
template <class T>
using Rows = const T* [3][3];

// Sums over the neighbours across x for one row: smooth = [1 2 1] x [1 2 1] of the values; alongY and alongZ
// are differences along y and z, smoothed along the other. Entry n + 1 belongs to voxel n; the ends repeat
// (clamped).
template <class T, class Sum>
void SumAcross(const Rows<T>& r, std::size_t count, Sum* HWY_RESTRICT smooth, Sum* HWY_RESTRICT alongY,
               Sum* HWY_RESTRICT alongZ) {
  for (std::size_t n = 0; n < count; ++n) {
    const Sum a = Sum(r[0][0][n]), b = Sum(r[0][1][n]), c = Sum(r[0][2][n]);
    const Sum d = Sum(r[1][0][n]), e = Sum(r[1][1][n]), f = Sum(r[1][2][n]);
    const Sum g = Sum(r[2][0][n]), h = Sum(r[2][1][n]), i = Sum(r[2][2][n]);
    const Sum before = (a + c) + 2 * b, at = (d + f) + 2 * e, behind = (g + i) + 2 * h;
    smooth[n + 1] = (before + behind) + 2 * at;
    alongY[n + 1] = ((c - a) + (i - g)) + 2 * (f - d);
    alongZ[n + 1] = behind - before;
  }
  for (Sum* s : {smooth, alongY, alongZ}) {
    s[0] = s[1];
    s[count + 1] = s[count];
  }
}

// Finishes one row along x: gradients in units of 1/32, shifted right with rounding, and the density, as four
// 16-bit integers per voxel.
void FinishRow16(const std::int16_t* density, const std::int32_t* smooth, const std::int32_t* alongY,
                 const std::int32_t* alongZ, std::size_t count, int shift, std::int16_t* HWY_RESTRICT out) {
  const hn::ScalableTag<std::int32_t> d32;
  const hn::Rebind<std::int16_t, decltype(d32)> d16;
  const auto half = hn::Set(d32, shift > 0 ? 1 << (shift - 1) : 0);
  const auto demote = [&](auto v) { return hn::DemoteTo(d16, hn::ShiftRightSame(hn::Add(v, half), shift)); };
  const auto smoothed = [&](const std::int32_t* s, std::size_t n) {
    const auto middle = hn::LoadU(d32, s + n + 1);
    return hn::Add(hn::Add(hn::LoadU(d32, s + n), hn::LoadU(d32, s + n + 2)), hn::Add(middle, middle));
  };
  const std::size_t lanes = hn::Lanes(d32);
  // The scratch rows and `part` have room for a full last vector.
  HWY_ALIGN std::int16_t part[4 * HWY_MAX_BYTES / sizeof(std::int32_t)];
  for (std::size_t n = 0; n < count; n += lanes) {
    const bool whole = n + lanes <= count;
    const auto x = demote(hn::Sub(hn::LoadU(d32, smooth + n + 2), hn::LoadU(d32, smooth + n)));
    hn::StoreInterleaved4(x, demote(smoothed(alongY, n)), demote(smoothed(alongZ, n)),
                          hn::LoadU(d16, density + n), d16, whole ? out + 4 * n : part);
    if (!whole) std::copy_n(part, 4 * (count - n), out + 4 * n);
  }
}

void FinishRow32(const float* smooth, const float* alongY, const float* alongZ, std::size_t count,
                 float scale, float* HWY_RESTRICT out) {
  for (std::size_t n = 0; n < count; ++n) {
    out[4 * n] = (smooth[n + 2] - smooth[n]) * scale;
    out[4 * n + 1] = ((alongY[n] + alongY[n + 2]) + 2 * alongY[n + 1]) * scale;
    out[4 * n + 2] = ((alongZ[n] + alongZ[n + 2]) + 2 * alongZ[n + 1]) * scale;
    out[4 * n + 3] = 0;
  }
}

template <class T>
void Row16(const Rows<T>& rows, std::size_t count, int shift, std::int32_t* scratch, std::size_t stride,
           std::int16_t* out) {
  SumAcross<T, std::int32_t>(rows, count, scratch, scratch + stride, scratch + 2 * stride);
  auto* density = reinterpret_cast<std::int16_t*>(scratch + 3 * stride);
  constexpr int shifted = std::is_same_v<T, std::uint16_t> ? 32768 : 0;
  for (std::size_t n = 0; n < count; ++n) density[n] = std::int16_t(int(rows[1][1][n]) - shifted);
  FinishRow16(density, scratch, scratch + stride, scratch + 2 * stride, count, shift, out);
}

template <class T>
void Row32(const Rows<T>& rows, std::size_t count, float scale, float* scratch, std::size_t stride,
           float* out) {
  SumAcross<T, float>(rows, count, scratch, scratch + stride, scratch + 2 * stride);
  FinishRow32(scratch, scratch + stride, scratch + 2 * stride, count, scale, out);
}

// One function pointer per stored type, because an overload set cannot be exported.
struct RowKernels {
  decltype(&Row16<std::uint8_t>) u8;
  decltype(&Row16<std::int16_t>) i16;
  decltype(&Row16<std::uint16_t>) u16;
  decltype(&Row32<std::uint8_t>) u8Float;
  decltype(&Row32<std::int16_t>) i16Float;
  decltype(&Row32<std::uint16_t>) u16Float;
  decltype(&Row32<float>) f32Float;
};

const void* ChooseRowKernels() {
  static constexpr RowKernels kernels{Row16<std::uint8_t>, Row16<std::int16_t>, Row16<std::uint16_t>,
                                      Row32<std::uint8_t>, Row32<std::int16_t>, Row32<std::uint16_t>,
                                      Row32<float>};
  return &kernels;
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(ChooseRowKernels);

namespace {

template <class T>
using Rows = const T* [3][3];

template <class T, class Sum, class Out>
using RowKernel = void (*)(const Rows<T>&, std::size_t, Out, Sum*, std::size_t,
                           std::conditional_t<std::is_same_v<Sum, float>, float, std::int16_t>*);

// Has the same layout as the RowKernels of every target.
struct RowKernels {
  RowKernel<std::uint8_t, std::int32_t, int> u8;
  RowKernel<std::int16_t, std::int32_t, int> i16;
  RowKernel<std::uint16_t, std::int32_t, int> u16;
  RowKernel<std::uint8_t, float, float> u8Float;
  RowKernel<std::int16_t, float, float> i16Float;
  RowKernel<std::uint16_t, float, float> u16Float;
  RowKernel<float, float, float> f32Float;

  auto of(std::uint8_t, std::int32_t) const { return u8; }
  auto of(std::int16_t, std::int32_t) const { return i16; }
  auto of(std::uint16_t, std::int32_t) const { return u16; }
  auto of(std::uint8_t, float) const { return u8Float; }
  auto of(std::int16_t, float) const { return i16Float; }
  auto of(std::uint16_t, float) const { return u16Float; }
  auto of(float, float) const { return f32Float; }
};

// Fills rows of gradients, for one thread.
template <class Sum, class T, class Factor>
class RowFiller {
 public:
  RowFiller(const std::vector<T>& stored, glm::ivec3 size, Factor factor)
      : stored_(stored),
        size_(size),
        factor_(factor),
        kernel_(static_cast<const RowKernels*>(HWY_DYNAMIC_DISPATCH(ChooseRowKernels)())->of(T{}, Sum{})),
        stride_(std::size_t(size.x) + 2 + longestVector),
        scratch_(4 * stride_) {}

  // Row n of those along i, as Gradients16 counts them.
  template <class Out>
  void operator()(std::int64_t row, Out* out) {
    const int j = int(row % size_.y), k = int(row / size_.y);
    Rows<T> rows;
    for (int dz = 0; dz < 3; ++dz)
      for (int dy = 0; dy < 3; ++dy) {
        const std::int64_t y = std::clamp(j + dy - 1, 0, size_.y - 1),
                           z = std::clamp(k + dz - 1, 0, size_.z - 1);
        rows[dz][dy] = stored_.data() + (z * size_.y + y) * size_.x;
      }
    kernel_(rows, std::size_t(size_.x), factor_, scratch_.data(), stride_, out);
  }

 private:
  static constexpr std::size_t longestVector =
      64;  // bytes of any CPU target; HWY_MAX_BYTES here is only the baseline's
  const std::vector<T>& stored_;
  const glm::ivec3 size_;
  const Factor factor_;
  decltype(RowKernels().of(T{}, Sum{})) kernel_;
  const std::size_t stride_;
  std::vector<Sum> scratch_;
};

// Runs the row kernel over all rows on all cores: use(row, draw) calls draw(out) to fill a row.
template <class Sum, class T, class Factor, class Use>
void overRows(const std::vector<T>& stored, glm::ivec3 size, Factor factor, const Use& use) {
  parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    RowFiller<Sum, T, Factor> fill(stored, size, factor);
    for (std::int64_t row = begin; row < end; ++row) use(row, [&](auto* out) { fill(row, out); });
  });
}

}  // namespace

glm::dvec3 sobelAt(const Volume& volume, int i, int j, int k) {
  constexpr double smooth[3] = {0.25, 0.5, 0.25}, derivative[3] = {-0.5, 0, 0.5};
  const glm::ivec3 size = volume.size();
  glm::dvec3 g(0);
  for (int dz = 0; dz < 3; ++dz)
    for (int dy = 0; dy < 3; ++dy)
      for (int dx = 0; dx < 3; ++dx) {
        const double v =
            volume.value(std::clamp(i + dx - 1, 0, size.x - 1), std::clamp(j + dy - 1, 0, size.y - 1),
                         std::clamp(k + dz - 1, 0, size.z - 1));
        g +=
            v * glm::dvec3(derivative[dx] * smooth[dy] * smooth[dz], smooth[dx] * derivative[dy] * smooth[dz],
                           smooth[dx] * smooth[dy] * derivative[dz]);
      }
  return g;
}

namespace {

// Returns the right shift that fits gradients in units of 1/32 stored value into 16 bits.
int shiftOf(ValueRange range, double slope) {
  const double largest = 16 * (range.high - range.low) / std::abs(slope);
  int shift = 0;
  while (largest / double(1 << shift) > 32767) ++shift;
  return shift;
}

}  // namespace

double gradients16Scale(ValueRange range, double slope) {
  return slope * double(1 << shiftOf(range, slope)) / 32;
}

bool gradients16AreRounded(ValueRange range, double slope) { return shiftOf(range, slope) > 0; }

Gradients16 makeGradients16(glm::ivec3 size, double scale) {
  const int row = rowStride(size.x, 4 * sizeof(std::int16_t));
  return {Buffer<std::int16_t>(std::size_t(4) * row * size.y * size.z), scale, row};
}

Gradients16 sobel16(const Volume& volume) {
  const ValueRange range = valueRange(volume);
  const int shift = shiftOf(range, volume.slope());
  Gradients16 g = makeGradients16(volume.size(), gradients16Scale(range, volume.slope()));
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        if constexpr (!std::is_same_v<T, float>)
          overRows<std::int32_t>(stored, volume.size(), shift,
                                 [&](std::int64_t row, const auto& draw) { draw(g.row(row)); });
      },
      volume.stored());
  return g;
}

namespace {

// The bricks of one row along i, from the rows of voxels that they touch.
template <class Fill>
void fillBricks(GradientBricks16& bricks, std::int64_t brickRow, glm::ivec3 size, Fill& fill,
                std::vector<std::int16_t>& row) {
  constexpr int edge = GradientBricks16::row, cells = GradientBricks16::cells;
  const std::int32_t* first = bricks.first.data() + brickRow * bricks.count.x;
  if (std::all_of(first, first + bricks.count.x, [](std::int32_t n) { return n == 0; })) return;
  const int j0 = int(brickRow % bricks.count.y) * cells, k0 = int(brickRow / bricks.count.y) * cells;
  for (int k = k0; k < std::min(k0 + edge, size.z); ++k)
    for (int j = j0; j < std::min(j0 + edge, size.y); ++j) {
      fill(std::int64_t(k) * size.y + j, row.data());
      for (int b = 0; b < bricks.count.x; ++b) {
        if (first[b] == 0) continue;
        const int at = first[b] + (k - k0) * GradientBricks16::slice + (j - j0) * edge;
        std::copy_n(row.data() + 4 * b * cells, 4 * std::min(edge, size.x - b * cells),
                    bricks.xyzd.data() + std::size_t(4) * at);
      }
    }
}

}  // namespace

std::uint64_t GradientBricks16::bytesOf(std::int64_t bricks, glm::ivec3 count) {
  return std::uint64_t(bricks + 1) * all * 4 * sizeof(std::int16_t) +
         std::uint64_t(count.x) * count.y * count.z * sizeof(std::int32_t);
}

GradientBricks16 sobelBricks16(const Volume& volume, const std::vector<std::uint8_t>& kept) {
  const ValueRange range = valueRange(volume);
  const int shift = shiftOf(range, volume.slope());
  const glm::ivec3 size = volume.size();
  GradientBricks16 bricks{GradientBricks16::countOf(size), {}, {}, gradients16Scale(range, volume.slope())};
  std::int32_t next = 0;  // brick 0 shows nothing
  for (const std::uint8_t keep : kept) bricks.first.push_back(keep ? next += GradientBricks16::all : 0);
  bricks.xyzd = Buffer<std::int16_t>(std::size_t(4) * (std::size_t(next) + GradientBricks16::all));
  const int out = int(std::ranges::find(kept, 0) - kept.begin());
  const glm::ivec3 corner =
      GradientBricks16::cells * glm::ivec3(out % bricks.count.x, out / bricks.count.x % bricks.count.y,
                                           out / (bricks.count.x * bricks.count.y));
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        if constexpr (!std::is_same_v<T, float>) {
          constexpr int shifted = std::is_same_v<T, std::uint16_t> ? 32768 : 0;
          const T hidden = stored[(std::size_t(corner.z) * size.y + corner.y) * size.x + corner.x];
          for (int n = 0; n < GradientBricks16::all; ++n) {
            std::fill_n(bricks.xyzd.data() + 4 * n, 3, std::int16_t(0));
            bricks.xyzd[std::size_t(4 * n + 3)] = std::int16_t(int(hidden) - shifted);
          }
          const std::int64_t rows = std::int64_t(bricks.count.y) * bricks.count.z;
          parallelFor(rows, 0, [&](std::int64_t begin, std::int64_t end) {
            RowFiller<std::int32_t, T, int> fill(stored, size, shift);
            std::vector<std::int16_t> row(std::size_t(4) * size.x);
            for (std::int64_t n = begin; n < end; ++n) fillBricks(bricks, n, size, fill, row);
          });
        }
      },
      volume.stored());
  return bricks;
}

namespace {

template <class Use>
double overSobelRows32(const Volume& volume, const Use& use) {
  return withFloatUnits(volume, [&](const auto& samples, float sign) {
    overRows<float>(samples, volume.size(), sign / 32, use);
  });
}

}  // namespace

Gradients32 sobel32(const Volume& volume) {
  Gradients32 g{Buffer<float>(std::size_t(4) * volume.geometry().voxelCount())};
  g.scale = overSobelRows32(volume, [&](std::int64_t row, const auto& draw) {
    draw(g.xyz0.data() + std::size_t(4) * volume.size().x * row);
  });
  return g;
}

double sobelRows(const Volume& volume, const UseGradientRow& use) {
  const std::size_t count = std::size_t(volume.size().x);
  return overSobelRows32(volume, [&](std::int64_t row, const auto& draw) {
    std::vector<float> xyz0(4 * count);
    draw(xyz0.data());
    use(std::size_t(row) * count, xyz0.data());
  });
}

}  // namespace volumen
#endif  // HWY_ONCE
