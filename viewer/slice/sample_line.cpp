#include "viewer/slice/sample_line.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "viewer/slice/sample_line.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using DF = hn::ScalableTag<float>;
using VF = hn::Vec<DF>;

// Points are processed in chunks: first all positions, then their voxels, then the interpolation.
constexpr int kChunk = 64;
static_assert(kChunk <= lineSlack && kChunk % hn::MaxLanes(DF()) == 0);

/// Number of taps before the point's own voxel along an axis.
constexpr int BeforeOf(int taps) { return taps == 4 ? 1 : 0; }

struct Places {
  HWY_ALIGN std::int32_t voxel[3][kChunk];
  HWY_ALIGN float part[3][kChunk];  ///< Fraction of the way to the next voxel, 0 .. 1
};

template <Interpolation kHow>
HWY_INLINE void LocateAlong(int axis, const SampleLine& line, std::int64_t first, int count, int size,
                            Places& out) {
  const hn::ScalableTag<double> dd;
  const hn::Rebind<float, decltype(dd)> df;
  const hn::Rebind<std::int32_t, decltype(dd)> di;
  const auto start = hn::Set(dd, line.start[axis]), step = hn::Set(dd, line.step[axis]);
  const auto units = hn::Set(dd, positionUnits), last = hn::Set(dd, double(size - 1));
  for (int n = 0; n < count; n += int(hn::Lanes(dd))) {
    auto x = hn::Add(hn::Mul(hn::Iota(dd, double(first + n)), step), start);
    x = hn::Sub(hn::Add(x, units), units);
    if constexpr (kHow == Interpolation::nearest) x = hn::Floor(hn::Add(x, hn::Set(dd, 0.5)));
    if constexpr (kHow != Interpolation::cubic) x = hn::Min(hn::Max(x, hn::Zero(dd)), last);
    const auto voxel = hn::Floor(x);
    hn::Store(hn::DemoteTo(di, voxel), di, out.voxel[axis] + n);
    hn::Store(hn::DemoteTo(df, hn::Sub(x, voxel)), df, out.part[axis] + n);
  }
}

/// Pairs of neighbouring voxels along x, for each point.
template <class T>
using Pairs = T[kChunk][2];

struct PairOf {
  VF first, second;
};

template <class T>
HWY_INLINE PairOf LoadPairs(const T (*pairs)[2]) {
  const DF df;
#if HWY_TARGET == HWY_SCALAR
  return {hn::Set(df, float(pairs[0][0])), hn::Set(df, float(pairs[0][1]))};
#else
  const hn::RebindToSigned<DF> di;
  const auto floats = [&](auto first, auto second) {
    return PairOf{hn::ConvertTo(df, first), hn::ConvertTo(df, second)};
  };
  if constexpr (std::is_same_v<T, float>) {
    PairOf of;
    hn::LoadInterleaved2(df, pairs[0], of.first, of.second);
    return of;
  } else if constexpr (sizeof(T) == 1) {
    const auto both = hn::PromoteTo(
        di, hn::BitCast(hn::Rebind<std::uint16_t, DF>(),
                        hn::Load(hn::Repartition<T, hn::Rebind<std::uint16_t, DF>>(), pairs[0])));
    return floats(hn::And(both, hn::Set(di, 255)), hn::ShiftRight<8>(both));
  } else {
    const auto both = hn::BitCast(di, hn::Load(hn::Repartition<T, DF>(), pairs[0]));
    if constexpr (std::is_signed_v<T>)
      return floats(hn::ShiftRight<16>(hn::ShiftLeft<16>(both)), hn::ShiftRight<16>(both));
    const hn::RebindToUnsigned<DF> du;
    return floats(hn::And(both, hn::Set(di, 0xffff)),
                  hn::BitCast(di, hn::ShiftRight<16>(hn::BitCast(du, both))));
  }
#endif
}

/// Returns the offsets of the kTaps voxels along an axis, clamped to the volume.
template <int kTaps>
HWY_INLINE void TapOffsets(int voxel, int size, std::ptrdiff_t stride, std::ptrdiff_t (&offsets)[kTaps]) {
  for (int t = 0; t < kTaps; ++t) offsets[t] = std::clamp(voxel + t - BeforeOf(kTaps), 0, size - 1) * stride;
}

/// Collects the voxels around each point as pairs: taps[((z kTaps + y) kTaps + x) / 2].
template <class T, int kTaps>
HWY_INLINE void CollectClamped(const T* stored, glm::ivec3 size, const Places& at, int first, int last,
                               Pairs<T>* taps) {
  for (int n = first; n < last; ++n) {
    std::ptrdiff_t x[kTaps], y[kTaps], z[kTaps];
    TapOffsets(at.voxel[0][n], size.x, 1, x);
    TapOffsets(at.voxel[1][n], size.y, size.x, y);
    TapOffsets(at.voxel[2][n], size.z, std::ptrdiff_t(size.x) * size.y, z);
    for (int c = 0; c < kTaps; ++c)
      for (int b = 0; b < kTaps; ++b)
        for (int a = 0; a < kTaps; ++a)
          taps[((c * kTaps + b) * kTaps + a) / 2][n][a % 2] = stored[z[c] + y[b] + x[a]];
  }
}

/// Does the same for points far enough from all faces that no neighbour is clamped.
template <class T, int kTaps>
HWY_INLINE void CollectInner(const T* stored, glm::ivec3 size, const Places& at, int first, int last,
                             Pairs<T>* taps) {
  const std::ptrdiff_t row = size.x, slice = row * size.y, before = BeforeOf(kTaps) * (1 + row + slice);
  for (int n = first; n < last; ++n) {
    const T* const from = stored + (at.voxel[2][n] * slice + at.voxel[1][n] * row + at.voxel[0][n] - before);
    for (int c = 0; c < kTaps; ++c)
      for (int b = 0; b < kTaps; ++b)
        for (int a = 0; a < kTaps; a += 2)
          std::memcpy(taps[((c * kTaps + b) * kTaps + a) / 2][n], from + c * slice + b * row + a,
                      2 * sizeof(T));
  }
}

/// Returns whether no voxel around the point is clamped.
template <int kTaps>
HWY_INLINE bool IsInner(const Places& at, int n, glm::ivec3 size) {
  const auto along = [&](int a) {
    const int before = at.voxel[a][n] - BeforeOf(kTaps);
    return before >= 0 && before + kTaps <= size[a];
  };
  return along(0) && along(1) && along(2);
}

template <class T, int kTaps>
HWY_INLINE void Collect(const T* stored, glm::ivec3 size, const Places& at, int count, Pairs<T>* taps) {
  // Inner points are contiguous on a line.
  int first = 0, last = count;
  while (first < last && !IsInner<kTaps>(at, first, size)) ++first;
  while (first < last && !IsInner<kTaps>(at, last - 1, size)) --last;
  CollectClamped<T, kTaps>(stored, size, at, 0, first, taps);
  CollectInner<T, kTaps>(stored, size, at, first, last, taps);
  CollectClamped<T, kTaps>(stored, size, at, last, count, taps);
}

/// Linear interpolation that is exact for equal voxels.
struct Linear {
  explicit Linear(VF part) : f(part) {}
  HWY_INLINE VF operator()(const VF (&v)[2]) const { return hn::Add(v[0], hn::Mul(f, hn::Sub(v[1], v[0]))); }
  VF f;
};

/// Catmull-Rom between v[1] and v[2] as differences from v[1]: exact at v[1] and where all are equal.
struct Cubic {
  explicit Cubic(VF t) {
    const DF df;
    const VF half = hn::Set(df, 0.5f), squared = hn::Mul(t, t), u = hn::Sub(t, hn::Set(df, 1));
    before = hn::Neg(hn::Mul(half, hn::Mul(t, hn::Mul(u, u))));
    next = hn::Mul(half, hn::Mul(t, hn::Add(hn::Sub(hn::Set(df, 1), hn::Mul(hn::Set(df, 3), squared)),
                                            hn::Mul(hn::Set(df, 4), t))));
    behind = hn::Mul(half, hn::Mul(squared, u));
  }
  HWY_INLINE VF operator()(const VF (&v)[4]) const {
    const auto of = [&](VF weight, VF value) { return hn::Mul(weight, hn::Sub(value, v[1])); };
    return hn::Add(v[1], hn::Add(hn::Add(of(before, v[0]), of(next, v[2])), of(behind, v[3])));
  }
  VF before, next, behind;
};

template <class T, class Along, int kTaps>
HWY_INLINE VF Blend(const Pairs<T>* taps, const Places& at, int n) {
  const DF df;
  const Along alongX(hn::Load(df, at.part[0] + n)), alongY(hn::Load(df, at.part[1] + n)),
      alongZ(hn::Load(df, at.part[2] + n));
  VF slices[kTaps], rows[kTaps], voxels[kTaps];
  for (int c = 0; c < kTaps; ++c) {
    for (int b = 0; b < kTaps; ++b) {
      for (int a = 0; a < kTaps; a += 2) {
        const PairOf pair = LoadPairs(taps[((c * kTaps + b) * kTaps + a) / 2] + n);
        voxels[a] = pair.first, voxels[a + 1] = pair.second;
      }
      rows[b] = alongX(voxels);
    }
    slices[c] = alongY(rows);
  }
  return alongZ(slices);
}

/// Calls use(places, values, count) for each chunk of points.
template <Interpolation kHow, class Use>
HWY_INLINE void OverChunks(glm::ivec3 size, const SampleLine& line, SampleRange range, float* values,
                           const Use& use) {
  Places at = {};
  for (std::int64_t first = range.first; first < range.last; first += kChunk, values += kChunk) {
    const int count = int(std::min<std::int64_t>(kChunk, range.last - first));
    for (int a = 0; a < 3; ++a)
      if (line.step[a] != 0 || first == range.first) LocateAlong<kHow>(a, line, first, count, size[a], at);
    use(at, values, count);
  }
}

template <class T>
void TakeNearest(const void* stored, glm::ivec3 size, const SampleLine& line, SampleRange range,
                 float* values) {
  OverChunks<Interpolation::nearest>(size, line, range, values, [&](const Places& at, float* out, int count) {
    for (int n = 0; n < count; ++n)
      out[n] = float(static_cast<const T*>(
          stored)[(std::ptrdiff_t(at.voxel[2][n]) * size.y + at.voxel[1][n]) * size.x + at.voxel[0][n]]);
  });
}

template <class T, Interpolation kHow>
void Interpolate(const void* stored, glm::ivec3 size, const SampleLine& line, SampleRange range,
                 float* values) {
  using Along = std::conditional_t<kHow == Interpolation::linear, Linear, Cubic>;
  constexpr int kTaps = kHow == Interpolation::linear ? 2 : 4;
  HWY_ALIGN Pairs<T> taps[kTaps * kTaps * kTaps / 2] = {};
  const T* const samples = static_cast<const T*>(stored);
  OverChunks<kHow>(size, line, range, values, [&](const Places& at, float* out, int count) {
    Collect<T, kTaps>(samples, size, at, count, taps);
    for (int n = 0; n < count; n += int(hn::Lanes(DF())))
      hn::StoreU(Blend<T, Along, kTaps>(taps, at, n), DF(), out + n);
  });
}

/// Loads samples as floats.
template <class T>
HWY_INLINE VF LoadFloats(const T* samples) {
  const DF df;
  if constexpr (std::is_same_v<T, float>)
    return hn::Load(df, samples);
  else
    return hn::ConvertTo(df, hn::PromoteTo(hn::RebindToSigned<DF>(), hn::Load(hn::Rebind<T, DF>(), samples)));
}

/// Interpolates linearly between the four voxels of one layer across kAxis; along kAxis the points lie on
/// voxels.
template <class T, int kAxis>
void InterpolateInLayer(const void* stored, glm::ivec3 size, const SampleLine& line, SampleRange range,
                        float* values) {
  constexpr int kU = kAxis == 0 ? 1 : 0, kV = kAxis == 2 ? 1 : 2;
  const std::ptrdiff_t strides[] = {1, size.x, std::ptrdiff_t(size.x) * size.y};
  HWY_ALIGN T corners[4][kChunk] = {};
  OverChunks<Interpolation::linear>(size, line, range, values, [&](const Places& at, float* out, int count) {
    for (int n = 0; n < count; ++n) {
      const T* const from = static_cast<const T*>(stored) + at.voxel[2][n] * strides[2] +
                            at.voxel[1][n] * strides[1] + at.voxel[0][n];
      const std::ptrdiff_t u = at.voxel[kU][n] + 1 < size[kU] ? strides[kU] : 0,
                           v = at.voxel[kV][n] + 1 < size[kV] ? strides[kV] : 0;
      corners[0][n] = from[0], corners[1][n] = from[u], corners[2][n] = from[v], corners[3][n] = from[u + v];
    }
    for (int n = 0; n < count; n += int(hn::Lanes(DF()))) {
      const Linear alongU(hn::Load(DF(), at.part[kU] + n)), alongV(hn::Load(DF(), at.part[kV] + n));
      const VF low[] = {LoadFloats(corners[0] + n), LoadFloats(corners[1] + n)},
               high[] = {LoadFloats(corners[2] + n), LoadFloats(corners[3] + n)};
      hn::StoreU(alongV({alongU(low), alongU(high)}), DF(), out + n);
    }
  });
}

LineKernel ChooseLayer(const VoxelValues& stored, int axis) {
  return std::visit(
      [&]<class T>(const std::vector<T>&) -> LineKernel {
        return axis == 0   ? InterpolateInLayer<T, 0>
               : axis == 1 ? InterpolateInLayer<T, 1>
                           : InterpolateInLayer<T, 2>;
      },
      stored);
}

template <class T>
LineKernel ChooseHow(Interpolation how) {
  return how == Interpolation::nearest  ? TakeNearest<T>
         : how == Interpolation::linear ? Interpolate<T, Interpolation::linear>
                                        : Interpolate<T, Interpolation::cubic>;
}

LineKernel ChooseLine(const VoxelValues& stored, Interpolation how) {
  return std::visit([&]<class T>(const std::vector<T>&) { return ChooseHow<T>(how); }, stored);
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace volumen {

HWY_EXPORT(ChooseLine);
HWY_EXPORT(ChooseLayer);

LineKernel chooseLineKernel(const VoxelValues& stored, Interpolation interpolation) {
  return HWY_DYNAMIC_DISPATCH(ChooseLine)(stored, interpolation);
}

LineKernel chooseLayerKernel(const VoxelValues& stored, int axis) {
  return HWY_DYNAMIC_DISPATCH(ChooseLayer)(stored, axis);
}

LineKernel chooseKernel(const Volume& volume, Interpolation interpolation) {
  const bool isFlat = volume.size().z == 1 && interpolation == Interpolation::linear;
  return isFlat ? chooseLayerKernel(volume.stored(), 2) : chooseLineKernel(volume.stored(), interpolation);
}

namespace {

std::int64_t clampedIndex(double n, SampleRange range) {
  if (!(n > double(range.first))) return range.first;
  return n < double(range.last) ? std::int64_t(n) : range.last;
}

bool isInside(const SampleLine& line, std::int64_t n, int a, glm::ivec3 size) {
  const double x = line.at(n, a);
  return x >= -0.5 && x <= size[a] - 0.5;
}

bool isInside(const SampleLine& line, std::int64_t n, glm::ivec3 size) {
  return isInside(line, n, 0, size) && isInside(line, n, 1, size) && isInside(line, n, 2, size);
}

}  // namespace

SampleRange insideBox(const SampleLine& line, SampleRange range, glm::ivec3 size) {
  constexpr double margin = 0x1p-23;  // exceeds the rounding of positions
  for (int a = 0; a < 3; ++a) {
    if (line.step[a] == 0) {
      if (!isInside(line, range.first, a, size)) return {};
      continue;
    }
    double enter = (-0.5 - margin - line.start[a]) / line.step[a],
           leave = (size[a] - 0.5 + margin - line.start[a]) / line.step[a];
    if (enter > leave) std::swap(enter, leave);
    range = {clampedIndex(enter - 1, range), clampedIndex(leave + 2, range)};
  }
  while (range.first < range.last && !isInside(line, range.first, size)) ++range.first;
  while (range.first < range.last && !isInside(line, range.last - 1, size)) --range.last;
  return range;
}

}  // namespace volumen
#endif  // HWY_ONCE
