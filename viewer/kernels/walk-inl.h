// The walk of rays from cell to cell. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_WALK_INL_H_
#undef VOLUMEN_KERNELS_WALK_INL_H_
#else
#define VOLUMEN_KERNELS_WALK_INL_H_
#endif

#include "viewer/kernels/cells-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// One axis of a walk (Amanatides and Woo 1987). Each face is computed from the ray's start, so the starting
/// point of the walk changes no bit of it.
struct WalkAxis {
  VF start, inverse;  ///< Start of the ray in voxels; inverse of its move per step.
  VF index, face;     ///< The next face: its index, and its distance from the start in steps.
  VF turn;            ///< Offset from the next face to the one after: 1 or -1.
  VI cell, turnCell;  ///< Current cell, -1 before the first voxel; offset to the next cell.

  HWY_INLINE WalkAxis(VF rayStart, VF move, VF from) : start(rayStart) {
    const DF df;
    const MF still = hn::Lt(hn::Abs(move), Set(1e-6f)), isBack = hn::Lt(move, hn::Zero(df));
    turn = hn::IfThenElse(isBack, Set(-1), Set(1));
    turnCell = Truncated(turn);
    // Rays begin up to half a voxel before the first voxel; conversion truncates towards 0.
    cell = hn::Sub(Truncated(hn::Add(hn::Add(start, hn::Mul(from, move)), Set(1))), SetI(1));
    const VF next = hn::Add(hn::ConvertTo(df, cell), hn::IfThenElseZero(hn::Not(isBack), Set(1)));
    // A ray that does not move along this axis never reaches its next face.
    index = hn::IfThenElse(still, hn::Add(start, Set(1)), next);
    inverse = hn::IfThenElse(still, Set(1e30f), hn::Div(Set(1), hn::IfThenElse(still, Set(1), move)));
    SetFace();
  }

  HWY_INLINE void SetFace() { face = hn::Mul(hn::Sub(index, start), inverse); }

  /// Returns the cell clamped to the grid. Rays that ended long ago are far outside.
  HWY_INLINE VI Inside(int size) const { return hn::Min(hn::Max(cell, hn::Zero(DI())), SetI(size - 1)); }

  HWY_INLINE void PassTo(VF place) {
    const MF passed = hn::Le(face, place);
    index = hn::IfThenElse(passed, hn::Add(index, turn), index);
    cell = hn::IfThenElse(hn::RebindMask(DI(), passed), hn::Add(cell, turnCell), cell);
    SetFace();
  }
};

/// Takes the `open` rays of a packet through the steps [from, to), cell by cell. Calls emit(MF, middle,
/// length) with passages through visible cells, front to back on each ray. `length` is in steps, `middle` in
/// voxels.
template <class Emit>
HWY_INLINE void WalkCells(const RayInputs& f, const Packet& p, int from, int to, MF open, const Emit& emit) {
  const DF df;
  VF at = hn::Max(SampleAt(p, from), hn::Zero(df));
  // The last interval of a ray is shorter.
  const VF behind = hn::Sub(hn::Add(p.lastMiddle, p.lastMiddle), hn::Sub(p.steps, Set(1)));
  const VF end = hn::IfThenElseZero(open, hn::Min(behind, SampleAt(p, to)));
  WalkAxis x(p.start.x, p.move.x, at), y(p.start.y, p.move.y, at), z(p.start.z, p.move.z, at);
  while (!hn::AllFalse(df, hn::Lt(at, end))) {
    const VF upTo = hn::Min(hn::Min(x.face, y.face), hn::Min(z.face, end));
    const VF length = hn::Sub(upTo, at);
    const MF passes = hn::And(hn::Lt(at, end), hn::Gt(length, hn::Zero(df)));
    const MF seen =
        IsVisibleCell(*f.cells, passes, x.Inside(f.size.x), y.Inside(f.size.y), z.Inside(f.size.z));
    if (!hn::AllFalse(df, seen))
      emit(seen, Add(p.start, Scale(p.move, hn::Add(at, hn::Mul(length, Set(0.5f))))), length);
    at = hn::Max(at, upTo);
    x.PassTo(upTo);
    y.PassTo(upTo);
    z.PassTo(upTo);
  }
}

/// Calls walk(from, to) for each run of consecutive steps that `bits` names: bit n stands for `step` + n.
template <class Walk>
HWY_INLINE void OverRuns(int step, std::uint64_t bits, const Walk& walk) {
  while (bits) {
    const int begin = int(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
    const int count = int(hwy::Num0BitsBelowLS1Bit_Nonzero64(~(bits >> begin)));
    walk(step + begin, step + begin + count);
    bits &= ~(((std::uint64_t(1) << count) - 1) << begin);
  }
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
