// The density of a ray inside a cell, compiled once a CPU target.
#if defined(VOLUMEN_RENDER_KERNELS_PASSAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_RENDER_KERNELS_PASSAGE_INL_H_
#undef VOLUMEN_RENDER_KERNELS_PASSAGE_INL_H_
#else
#define VOLUMEN_RENDER_KERNELS_PASSAGE_INL_H_
#endif

#include "viewer/render/kernels/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// c0 + c1 s + c2 s^2 + c3 s^3: the density along a ray inside one cell, exactly (it is trilinear there);
/// s from -1 to 1, front to back.
struct Cubic {
  VF c0, c1, c2, c3;

  HWY_INLINE VF At(VF s) const {
    return hn::Add(c0, hn::Mul(s, hn::Add(c1, hn::Mul(s, hn::Add(c2, hn::Mul(s, c3))))));
  }
};

/// A passage through a cell: the place of its middle there, and how far it reaches to either side (voxels).
struct Passage {
  Cell cell;
  V3 half;
};

/// How much of `half` counts: outside the voxels' centres the density is that of the nearest place between
/// them.
HWY_INLINE V3 HalfInside(const V3& place, const V3& clamped, const V3& half) {
  const auto along = [](VF at, VF inside, VF h) { return hn::IfThenElseZero(hn::Eq(at, inside), h); };
  return {along(place.x, clamped.x, half.x), along(place.y, clamped.y, half.y),
          along(place.z, clamped.z, half.z)};
}

/// The one whose middle lies at `place` (voxels) and that reaches as far as `half`.
HWY_INLINE Passage PassageAt(const Grid& grid, const V3& place, const V3& half) {
  const V3 clamped = grid.Clamped(place);
  return {grid.CellAt(clamped), HalfInside(place, clamped, half)};
}

/// The same in the cell of this lower corner, which may be one before the first or behind the last.
HWY_INLINE Passage PassageIn(const Grid& grid, const V3& lower, const V3& place, const V3& half) {
  const V3 clamped = grid.Clamped(place);
  return {grid.CellFrom(lower, clamped), HalfInside(place, clamped, half)};
}

/// The density along a passage through a cell of these corners.
HWY_INLINE Cubic DensityAlong(const Passage& passage, const Corners& v) {
  const Cell& cell = passage.cell;
  const V3& d = passage.half;
  struct Line {
    VF at, rise;
  } row[4];
  for (int r = 0; r < 4; ++r) {
    const VF across = hn::Sub(v.second[r], v.first[r]);
    row[r] = {hn::Add(v.first[r], hn::Mul(cell.fx, across)), hn::Mul(d.x, across)};
  }
  struct Square {
    VF c0, c1, c2;
  };
  const auto between = [&](const Line& a, const Line& b) {
    const VF at = hn::Sub(b.at, a.at), rise = hn::Sub(b.rise, a.rise);
    return Square{hn::Add(a.at, hn::Mul(cell.fy, at)),
                  hn::Add(a.rise, hn::Add(hn::Mul(cell.fy, rise), hn::Mul(d.y, at))), hn::Mul(d.y, rise)};
  };
  const Square p = between(row[0], row[1]), q = between(row[2], row[3]);
  const VF r0 = hn::Sub(q.c0, p.c0), r1 = hn::Sub(q.c1, p.c1), r2 = hn::Sub(q.c2, p.c2);
  return {hn::Add(p.c0, hn::Mul(cell.fz, r0)), hn::Add(p.c1, hn::Add(hn::Mul(cell.fz, r1), hn::Mul(d.z, r0))),
          hn::Add(p.c2, hn::Add(hn::Mul(cell.fz, r2), hn::Mul(d.z, r1))), hn::Mul(d.z, r2)};
}

/// The same of the passage of PassageAt.
template <class Store>
HWY_INLINE Cubic DensityAlong(const Grid& grid, const V3& place, const V3& half) {
  const Passage passage = PassageAt(grid, place, half);
  return DensityAlong(passage, Store::CornersOf(grid, passage.cell));
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
