// Density and gradients at positions in voxel space, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_SAMPLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_SAMPLE_INL_H_
#undef VOLUMEN_RENDER_KERNELS_SAMPLE_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_SAMPLE_INL_H_
#endif

#include "viewer/render/kernels/math-inl.h"
#include "viewer/render/kernels/trace.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// The cell around a position that is clamped to the grid (SCENE 2): index of its first voxel and the place
/// inside it, 0..1.
struct Cell {
  VI index;
  VF fx, fy, fz;
};

/// What every lookup of a frame needs, broadcast once a row.
class Grid {
 public:
  explicit Grid(const TraceFrame& f)
      : frame_(f),
        last_{Set(float(f.size.x - 1)), Set(float(f.size.y - 1)), Set(float(f.size.z - 1))},
        lastCellX_(SetI(f.size.x > 1 ? f.size.x - 2 : 0)),
        lastCellY_(SetI(f.size.y > 1 ? f.size.y - 2 : 0)),
        lastCellZ_(SetI(f.size.z > 1 ? f.size.z - 2 : 0)),
        rowStride_(f.size.x),
        sliceStride_(f.size.x * f.size.y),
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
    const DF df;
    const DI di;
    const VI x = hn::Min(hn::ConvertTo(di, clamped.x), lastCellX_);
    const VI y = hn::Min(hn::ConvertTo(di, clamped.y), lastCellY_);
    const VI z = hn::Min(hn::ConvertTo(di, clamped.z), lastCellZ_);
    const VI index = hn::Add(hn::Add(x, hn::Mul(y, SetI(rowStride_))), hn::Mul(z, SetI(sliceStride_)));
    return {index, hn::Sub(clamped.x, hn::ConvertTo(df, x)), hn::Sub(clamped.y, hn::ConvertTo(df, y)),
            hn::Sub(clamped.z, hn::ConvertTo(df, z))};
  }

  /// Index of the cell's corner row: 0, next row, next slice, both.
  HWY_INLINE VI Corner(const Cell& c, int dy, int dz) const {
    return hn::Add(c.index, SetI((dy ? nextRow_ : 0) + (dz ? nextSlice_ : 0)));
  }
  int nextColumn() const { return nextColumn_; }
  const TraceFrame& frame() const { return frame_; }

 private:
  const TraceFrame& frame_;
  V3 last_;
  VI lastCellX_, lastCellY_, lastCellZ_;
  int rowStride_, sliceStride_, nextRow_, nextSlice_, nextColumn_;
};

/// Interpolates between four rows, each already interpolated along x: (y0 z0), (y1 z0), (y0 z1), (y1 z1).
HWY_INLINE VF AcrossRows(VF a, VF b, VF c, VF d, const Cell& cell) {
  return Lerp(Lerp(a, b, cell.fy), Lerp(c, d, cell.fy), cell.fz);
}

/// 16-bit densities: one 32-bit gather brings a voxel and its neighbour along x. Gradients (SCENE 3):
/// trilinear interpolation of the stored ones, in stored units.
struct Int16Store {
  static HWY_INLINE VF Row(const Grid& grid, VI index, VF fx) {
    const DF df;
    const DI di;
    const VI both =
        hn::Xor(hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(grid.frame().density16),
                                 hn::ShiftLeft<1>(index)),
                SetI(int(grid.frame().flip16)));
    const VF a = hn::ConvertTo(df, hn::ShiftRight<16>(hn::ShiftLeft<16>(both)));
    const VF b = hn::ConvertTo(df, hn::ShiftRight<16>(both));
    return Lerp(a, b, fx);
  }

  static HWY_INLINE VF Density(const Grid& grid, const Cell& c) {
    return AcrossRows(Row(grid, grid.Corner(c, 0, 0), c.fx), Row(grid, grid.Corner(c, 1, 0), c.fx),
                      Row(grid, grid.Corner(c, 0, 1), c.fx), Row(grid, grid.Corner(c, 1, 1), c.fx), c);
  }

#if HWY_TARGET == HWY_SCALAR
  static HWY_INLINE V3 Gradient(const Grid& grid, const Cell& c) {
    const std::int16_t* base = grid.frame().gradients16;
    const auto component = [&](int n) {
      const auto row = [&](int dy, int dz) {
        const std::int16_t* voxel = base + std::size_t(4) * std::size_t(grid.Corner(c, dy, dz).raw) + n;
        return Lerp(Set(voxel[0]), Set(voxel[4]), c.fx);
      };
      return AcrossRows(row(0, 0), row(1, 0), row(0, 1), row(1, 1), c);
    };
    return {component(0), component(1), component(2)};
  }
#else
  /// Four loads a lane, each of a voxel and its neighbour along x (with one voxel along x the second counts
  /// nothing: fx is 0); much faster than gathers. Four components at a time on every CPU target.
  static HWY_INLINE V3 Gradient(const Grid& grid, const Cell& c) {
    const DF df;
    const hn::Full128<std::int16_t> d16;
    const hn::Half<decltype(d16)> half16;
    const hn::Full128<std::int32_t> d32;
    const hn::Full128<float> d4;
    constexpr int most = HWY_MAX_BYTES / 4;
    HWY_ALIGN std::int32_t index[4][most];
    HWY_ALIGN float fx[most], fy[most], fz[most], out[4 * most];
    for (int row = 0; row < 4; ++row) hn::Store(grid.Corner(c, row & 1, row >> 1), DI(), index[row]);
    hn::Store(c.fx, df, fx);
    hn::Store(c.fy, df, fy);
    hn::Store(c.fz, df, fz);
    const std::int16_t* base = grid.frame().gradients16;
    const auto lerp = [](auto a, auto b, auto f) { return hn::Add(a, hn::Mul(f, hn::Sub(b, a))); };
    for (int lane = 0; lane < int(hn::Lanes(df)); ++lane) {
      const auto alongX = hn::Set(d4, fx[lane]);
      const auto row = [&](int r) {
        const auto both = hn::LoadU(d16, base + std::size_t(4) * std::size_t(index[r][lane]));
        const auto a = hn::ConvertTo(d4, hn::PromoteTo(d32, hn::LowerHalf(half16, both)));
        const auto b = hn::ConvertTo(d4, hn::PromoteTo(d32, hn::UpperHalf(half16, both)));
        return lerp(a, b, alongX);
      };
      const auto alongY = hn::Set(d4, fy[lane]), alongZ = hn::Set(d4, fz[lane]);
      const auto before = lerp(row(0), row(1), alongY), behind = lerp(row(2), row(3), alongY);
      hn::Store(lerp(before, behind, alongZ), d4, out + 4 * lane);
    }
    V3 g;
    VF none;
    hn::LoadInterleaved4(df, out, g.x, g.y, g.z, none);
    return g;
  }
#endif
};

struct Float32Store {
  static HWY_INLINE VF Row(const Grid& grid, VI index, VF fx) {
    const DF df;
    const float* base = grid.frame().density32;
    return Lerp(hn::GatherIndex(df, base, index), hn::GatherIndex(df, base + grid.nextColumn(), index), fx);
  }

  static HWY_INLINE VF Density(const Grid& grid, const Cell& c) {
    return AcrossRows(Row(grid, grid.Corner(c, 0, 0), c.fx), Row(grid, grid.Corner(c, 1, 0), c.fx),
                      Row(grid, grid.Corner(c, 0, 1), c.fx), Row(grid, grid.Corner(c, 1, 1), c.fx), c);
  }

  static HWY_INLINE V3 Gradient(const Grid& grid, const Cell& c) {
    const auto voxel = [&](VI index) {
      const DF df;
      const float* base = grid.frame().gradients32;
      const VI at = hn::ShiftLeft<2>(index);
      return V3{hn::GatherIndex(df, base, at), hn::GatherIndex(df, base + 1, at),
                hn::GatherIndex(df, base + 2, at)};
    };
    const VI next = SetI(grid.nextColumn());
    const auto row = [&](int dy, int dz) {
      const VI index = grid.Corner(c, dy, dz);
      const V3 a = voxel(index), b = voxel(hn::Add(index, next));
      return V3{Lerp(a.x, b.x, c.fx), Lerp(a.y, b.y, c.fx), Lerp(a.z, b.z, c.fx)};
    };
    const V3 a = row(0, 0), b = row(1, 0), d = row(0, 1), e = row(1, 1);
    return {AcrossRows(a.x, b.x, d.x, e.x, c), AcrossRows(a.y, b.y, d.y, e.y, c),
            AcrossRows(a.z, b.z, d.z, e.z, c)};
  }
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
