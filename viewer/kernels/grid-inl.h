// Cells of a voxel grid, and interpolation in them. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_GRID_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_GRID_INL_H_
#undef VOLUMEN_KERNELS_GRID_INL_H_
#else
#define VOLUMEN_KERNELS_GRID_INL_H_
#endif

#include <array>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "viewer/kernels/math-inl.h"
#include "viewer/kernels/trace.h"
#include "viewer/volume/gradient_bricks.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// The cell around a position clamped to the grid (picture.md 2): index of its first voxel and position
/// inside it, 0..1.
struct Cell {
  VI index;
  VF fx, fy, fz;
};

/// Data for every lookup of a picture, broadcast once per row.
class Grid {
 public:
  /// Gradients, with densities beside them: in bricks, if they are.
  static Grid OfGradients(const RayInputs& f) { return {f, f.gradientRow, f.bricks}; }

  /// `rowVoxels`: RayInputs::densityRow or gradientRow, for the data to look up. `bricks`: RayInputs::bricks.
  Grid(const RayInputs& f, int rowVoxels, const std::int32_t* bricks = nullptr)
      : inputs_(f),
        bricks_(bricks),
        last_{Set(float(f.size.x - 1)), Set(float(f.size.y - 1)), Set(float(f.size.z - 1))},
        lastCellX_(SetI(f.size.x > 1 ? f.size.x - 2 : 0)),
        lastCellY_(SetI(f.size.y > 1 ? f.size.y - 2 : 0)),
        lastCellZ_(SetI(f.size.z > 1 ? f.size.z - 2 : 0)),
        rowStride_(bricks ? GradientBricks16::row : rowVoxels),
        sliceStride_(bricks ? GradientBricks16::slice : rowVoxels * f.size.y),
        brickCount_(GradientBricks16::countOf(f.size)),
        // Along an axis of one voxel the neighbour is the voxel itself.
        nextRow_(f.size.y > 1 ? rowStride_ : 0),
        nextSlice_(f.size.z > 1 ? sliceStride_ : 0),
        nextColumn_(f.size.x > 1 ? 1 : 0) {}

  HWY_INLINE V3 Clamped(const V3& p) const {
    const VF zero = hn::Zero(DF());
    return {hn::Min(hn::Max(p.x, zero), last_.x), hn::Min(hn::Max(p.y, zero), last_.y),
            hn::Min(hn::Max(p.z, zero), last_.z)};
  }

  HWY_INLINE Cell CellAt(const V3& clamped) const {
    const VI x = hn::Min(Truncated(clamped.x), lastCellX_);
    const VI y = hn::Min(Truncated(clamped.y), lastCellY_);
    const VI z = hn::Min(Truncated(clamped.z), lastCellZ_);
    return CellOf(x, y, z, clamped);
  }

  /// Returns the cell with the lower corner `lower` (voxels), or the nearest cell, and the position of
  /// `clamped` in it.
  HWY_INLINE Cell CellFrom(const V3& lower, const V3& clamped) const {
    const DF df;
    const auto inside = [&](VF at, VI last) { return hn::Min(Truncated(hn::Max(at, hn::Zero(df))), last); };
    const VI x = inside(lower.x, lastCellX_), y = inside(lower.y, lastCellY_),
             z = inside(lower.z, lastCellZ_);
    return CellOf(x, y, z, clamped);
  }

  /// Returns the distance in voxels from the cell's first row to its row r: 0, next row, next slice, or both.
  HWY_INLINE int Offset(int r) const { return (r & 1 ? nextRow_ : 0) + (r >> 1 ? nextSlice_ : 0); }
  /// Returns the starts of the four rows of the cell at the first voxel of `voxels`.
  template <class T>
  HWY_INLINE std::array<const T*, 4> Rows(const T* voxels) const {
    return {voxels, voxels + Offset(1), voxels + Offset(2), voxels + Offset(3)};
  }
  /// Returns the index of the first voxel of the cell's row r.
  HWY_INLINE VI Row(const Cell& c, int r) const { return hn::Add(c.index, SetI(Offset(r))); }
  int nextColumn() const { return nextColumn_; }

  /// Prefetches the part of `voxels` that positions from `low` to `high` (inside the grid) need. `elements`:
  /// values per voxel.
  template <class T>
  HWY_INLINE void Prefetch(const T* voxels, int elements, glm::vec3 low, glm::vec3 high) const {
    if (bricks_) return;  // near enough to one another
    const glm::ivec3 from(low), to = glm::min(glm::ivec3(high) + 1, inputs_.size - 1);
    const int line = 64 / int(sizeof(T)) / elements;
    for (int z = from.z; z <= to.z; ++z)
      for (int y = from.y; y <= to.y; ++y) {
        const std::int64_t row = std::int64_t(z) * sliceStride_ + std::int64_t(y) * rowStride_;
        for (int x = from.x / line * line; x <= to.x; x += line)
          __builtin_prefetch(voxels + elements * (row + x), 0, 2);
      }
  }
  const RayInputs& inputs() const { return inputs_; }

 private:
  HWY_INLINE Cell CellOf(VI x, VI y, VI z, const V3& place) const {
    const DF df;
    const VI index = bricks_ ? InBrick(x, y, z) : At(x, y, z, rowStride_, sliceStride_);
    return {index, hn::Sub(place.x, hn::ConvertTo(df, x)), hn::Sub(place.y, hn::ConvertTo(df, y)),
            hn::Sub(place.z, hn::ConvertTo(df, z))};
  }

  static HWY_INLINE VI At(VI x, VI y, VI z, int row, int slice) {
    return hn::Add(hn::Add(x, hn::Mul(y, SetI(row))), hn::Mul(z, SetI(slice)));
  }
  HWY_INLINE VI InBrick(VI x, VI y, VI z) const {
    constexpr int shift = GradientBricks16::shift;
    const VI cells = SetI(GradientBricks16::cells - 1);
    const VI brick = At(hn::ShiftRight<shift>(x), hn::ShiftRight<shift>(y), hn::ShiftRight<shift>(z),
                        brickCount_.x, brickCount_.x * brickCount_.y);
    return hn::Add(hn::GatherIndex(DI(), bricks_, brick),
                   At(hn::And(x, cells), hn::And(y, cells), hn::And(z, cells), rowStride_, sliceStride_));
  }

  const RayInputs& inputs_;
  const std::int32_t* bricks_;
  V3 last_;
  VI lastCellX_, lastCellY_, lastCellZ_;
  int rowStride_, sliceStride_;
  glm::ivec3 brickCount_;
  int nextRow_, nextSlice_, nextColumn_;
};

/// The index of each lane's cell.
struct CellIndices {
  HWY_ALIGN std::int32_t lane[hn::MaxLanes(DI())];

  explicit HWY_INLINE CellIndices(const Cell& c) { hn::Store(c.index, DI(), lane); }
};

/// Interpolates between four rows, each already interpolated along x: (y0 z0), (y1 z0), (y0 z1), (y1 z1).
HWY_INLINE VF AcrossRows(VF a, VF b, VF c, VF d, const Cell& cell) {
  return Lerp(Lerp(a, b, cell.fy), Lerp(c, d, cell.fy), cell.fz);
}

#if HWY_TARGET == HWY_SCALAR
/// Four values of a voxel as floats.
struct Four {
  float v[4];
};
HWY_INLINE Four LoadFour(const float* voxel) { return {{voxel[0], voxel[1], voxel[2], voxel[3]}}; }
HWY_INLINE Four LerpFour(const Four& a, const Four& b, float f) {
  Four x;
  for (int n = 0; n < 4; ++n) x.v[n] = a.v[n] + f * (b.v[n] - a.v[n]);
  return x;
}
HWY_INLINE void StoreFour(const Four& x, float* out) {
  for (int n = 0; n < 4; ++n) out[n] = x.v[n];
}
#else
using D4 = hn::Full128<float>;
using Four = hn::Vec<D4>;
HWY_INLINE Four LoadFour(const float* voxel) { return hn::LoadU(D4(), voxel); }
HWY_INLINE Four LerpFour(Four a, Four b, float f) {
  return hn::Add(a, hn::Mul(hn::Set(D4(), f), hn::Sub(b, a)));
}
HWY_INLINE void StoreFour(Four x, float* out) { hn::StoreU(x, D4(), out); }
#endif

/// Trilinear interpolation of four floats per voxel (`voxels`: of the whole grid). Going voxel by voxel is
/// much faster than one gather per component.
struct Interpolated {
  V3 xyz;
  VF w;
};
HWY_INLINE Interpolated InterpolateFour(const Grid& grid, const Cell& c, const float* voxels) {
  const DF df;
  constexpr int most = hn::MaxLanes(df);
  HWY_ALIGN float fx[most], fy[most], fz[most], out[4 * most];
  const CellIndices at(c);
  hn::Store(c.fx, df, fx);
  hn::Store(c.fy, df, fy);
  hn::Store(c.fz, df, fz);
  for (int lane = 0; lane < most; ++lane) {
    const auto row = [&](int r) {
      const float* a = voxels + std::int64_t(4) * (at.lane[lane] + grid.Offset(r));
      return LerpFour(LoadFour(a), LoadFour(a + 4 * grid.nextColumn()), fx[lane]);
    };
    const Four near = LerpFour(row(0), row(1), fy[lane]), far = LerpFour(row(2), row(3), fy[lane]);
    StoreFour(LerpFour(near, far, fz[lane]), out + 4 * lane);
  }
  Interpolated x;
  hn::LoadInterleaved4(df, out, x.xyz.x, x.xyz.y, x.xyz.z, x.w);
  return x;
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
