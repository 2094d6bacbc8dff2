// Density and gradient of a ray inside a cell. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_PASSAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_PASSAGE_INL_H_
#undef VOLUMEN_KERNELS_PASSAGE_INL_H_
#else
#define VOLUMEN_KERNELS_PASSAGE_INL_H_
#endif

#include "viewer/kernels/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// The exact course c0 + c1 s + c2 s^2 + c3 s^3 of a trilinear value along a ray inside one cell. Here s runs
/// from -1 (front) to 1 (back).
struct Cubic {
  VF c0, c1, c2, c3;

  HWY_INLINE VF At(VF s) const {
    return hn::Add(c0, hn::Mul(s, hn::Add(c1, hn::Mul(s, hn::Add(c2, hn::Mul(s, c3))))));
  }
  /// First and second derivative.
  HWY_INLINE VF RiseAt(VF s) const {
    return hn::Add(c1, hn::Mul(s, hn::Add(hn::Add(c2, c2), hn::Mul(Set(3), hn::Mul(s, c3)))));
  }
  HWY_INLINE VF SecondAt(VF s) const { return hn::Add(hn::Add(c2, c2), hn::Mul(Set(6), hn::Mul(s, c3))); }
  /// Returns a bound on the deviation from the straight lines from -1 to 0 and from 0 to 1.
  HWY_INLINE VF Bend() const {
    return hn::Add(hn::Mul(Set(0.25f), hn::Abs(c2)), hn::Mul(Set(0.385f), hn::Abs(c3)));
  }
};

HWY_INLINE Cubic Chosen(MF which, const Cubic& a, const Cubic& b) {
  return {hn::IfThenElse(which, a.c0, b.c0), hn::IfThenElse(which, a.c1, b.c1),
          hn::IfThenElse(which, a.c2, b.c2), hn::IfThenElse(which, a.c3, b.c3)};
}

/// A passage through a cell: the position of its middle there, and its reach to either side (voxels).
struct Passage {
  Cell cell;
  V3 half;
};

/// Returns the part of `half` that counts. Outside the voxel centres the density is that of the nearest
/// position between them.
HWY_INLINE V3 HalfInside(const V3& place, const V3& clamped, const V3& half) {
  const auto along = [](VF at, VF inside, VF h) { return hn::IfThenElseZero(hn::Eq(at, inside), h); };
  return {along(place.x, clamped.x, half.x), along(place.y, clamped.y, half.y),
          along(place.z, clamped.z, half.z)};
}

/// Returns the passage with its middle at `place` that reaches `half` to either side (voxels).
HWY_INLINE Passage PassageAt(const Grid& grid, const V3& place, const V3& half) {
  const V3 clamped = grid.Clamped(place);
  return {grid.CellAt(clamped), HalfInside(place, clamped, half)};
}

/// Returns the same as PassageAt(), in the cell with the lower corner `lower`. That may be a cell before the
/// first or behind the last.
HWY_INLINE Passage PassageIn(const Grid& grid, const V3& lower, const V3& place, const V3& half) {
  const V3 clamped = grid.Clamped(place);
  return {grid.CellFrom(lower, clamped), HalfInside(place, clamped, half)};
}

/// Interpolates between a and b, and returns exactly b at share 1, where a + (b - a) may be another float.
/// Even regions behind the last voxel centres then stay even and do not fall off a step of the curve.
HWY_INLINE VF Between(VF a, VF b, VF share) {
  return hn::IfThenElse(hn::Eq(share, Set(1)), b, hn::Add(a, hn::Mul(share, hn::Sub(b, a))));
}

/// Returns the trilinear value between the corners of a cell along a passage through it.
HWY_INLINE Cubic InterpolateAlong(const Corners& v, const Passage& p) {
  const V3& d = p.half;
  struct Line {
    VF at, rise;
  } row[4];
  for (int r = 0; r < 4; ++r) {
    const VF across = hn::Sub(v.second[r], v.first[r]);
    row[r] = {Between(v.first[r], v.second[r], p.cell.fx), hn::Mul(d.x, across)};
  }
  struct Square {
    VF c0, c1, c2;
  };
  const auto between = [&](const Line& a, const Line& b) {
    const VF at = hn::Sub(b.at, a.at), rise = hn::Sub(b.rise, a.rise);
    return Square{Between(a.at, b.at, p.cell.fy),
                  hn::Add(a.rise, hn::Add(hn::Mul(p.cell.fy, rise), hn::Mul(d.y, at))), hn::Mul(d.y, rise)};
  };
  const Square near = between(row[0], row[1]), far = between(row[2], row[3]);
  const VF r0 = hn::Sub(far.c0, near.c0), r1 = hn::Sub(far.c1, near.c1), r2 = hn::Sub(far.c2, near.c2);
  const VF fz = p.cell.fz;
  return {Between(near.c0, far.c0, fz), hn::Add(near.c1, hn::Add(hn::Mul(fz, r1), hn::Mul(d.z, r0))),
          hn::Add(near.c2, hn::Add(hn::Mul(fz, r2), hn::Mul(d.z, r1))), hn::Mul(d.z, r2)};
}

/// The lowest and the highest density at the corners of a cell.
struct CellRange {
  VF lowest, highest;

  /// Returns the value of the range that is nearest to 0.
  HWY_INLINE VF Base() const { return hn::Min(hn::Max(hn::Zero(DF()), lowest), highest); }
};

/// A density along a passage, counted from the base of its cell's range. Near plateaus and near 0, floats
/// then distinguish values that differ by less than an ulp of the plateau. `low` and `high` are the range,
/// counted the same way. Clamping to it keeps rounding from crossing a step of the curve.
struct DensityInCell {
  Cubic along;
  VF base, low, high;

  DensityInCell() = default;
  HWY_INLINE DensityInCell(const Cubic& c, const CellRange& range)
      : along(c), base(range.Base()), low(hn::Sub(range.lowest, base)), high(hn::Sub(range.highest, base)) {}

  HWY_INLINE VF At(VF s) const { return hn::Min(hn::Max(along.At(s), low), high); }
};
HWY_INLINE DensityInCell Chosen(MF which, const DensityInCell& a, const DensityInCell& b) {
  DensityInCell chosen;
  chosen.along = Chosen(which, a.along, b.along);
  chosen.base = hn::IfThenElse(which, a.base, b.base);
  chosen.low = hn::IfThenElse(which, a.low, b.low);
  chosen.high = hn::IfThenElse(which, a.high, b.high);
  return chosen;
}

/// The stored gradient along a passage, component by component.
struct CubicVector {
  Cubic x, y, z;

  HWY_INLINE V3 At(VF s) const { return {x.At(s), y.At(s), z.At(s)}; }
  HWY_INLINE V3 SecondAt(VF s) const { return {x.SecondAt(s), y.SecondAt(s), z.SecondAt(s)}; }
};
template <class Store>
HWY_INLINE CubicVector GradientAlong(const Grid& grid, const V3& place, const V3& half) {
  const Passage p = PassageAt(grid, place, half);
  const GradientCorners g = Store::GradientCornersOf(grid, p.cell);
  return {InterpolateAlong(g.x, p), InterpolateAlong(g.y, p), InterpolateAlong(g.z, p)};
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
