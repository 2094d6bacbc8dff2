// The cell faces that rays cross, in order. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_FACES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_FACES_INL_H_
#undef VOLUMEN_KERNELS_FACES_INL_H_
#else
#define VOLUMEN_KERNELS_FACES_INL_H_
#endif

#include "viewer/kernels/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Returns where rays end, in steps from their start; the last interval is shorter. Returns 0 for rays
/// without steps.
HWY_INLINE VF EndOf(const Packet& p) {
  return hn::Max(hn::Sub(hn::Add(p.lastMiddle, p.lastMiddle), hn::Sub(p.steps, Set(1))), hn::Zero(DF()));
}

/// The faces across one axis, `edge` voxels apart; `edge` is a power of two (Amanatides and Woo 1987). Each
/// face is computed from the ray's start, so the starting point of a walk changes no bit of it.
struct Faces {
  VF start, inverse;  ///< Start of the ray in voxels; inverse of its move per step.
  /// Offset to the face after the next: edge, -edge, or 0 for a ray that does not move along this axis.
  VF turn;
  VF ahead;        ///< Distance of the next face from the lower of the two faces around the ray: edge or 0.
  VF index, face;  ///< The next face: its position (voxels), and when the ray reaches it (steps).

  /// `from`: where the walk begins, in steps. The next face is the first one behind it.
  HWY_INLINE Faces(VF rayStart, VF move, VF from, float edge) : start(rayStart) {
    const DF df;
    const MF still = hn::Lt(hn::Abs(move), Set(1e-6f)), back = hn::Lt(move, Set(-1e-6f));
    const VF place = hn::Add(start, hn::IfThenElseZero(hn::Not(still), hn::Mul(from, move)));
    // Rays begin up to half a voxel before the first voxel; conversion truncates towards 0.
    const VI lower = hn::Sub(Truncated(hn::Add(hn::Mul(place, Set(1 / edge)), Set(1))), SetI(1));
    ahead = hn::IfThenElse(back, hn::Zero(df), Set(edge));
    turn = hn::IfThenElseZero(hn::Not(still), hn::IfThenElse(back, Set(-edge), Set(edge)));
    // A ray that does not move along this axis never reaches a face.
    inverse = hn::IfThenElse(still, Set(1e30f), hn::Div(Set(1), hn::IfThenElse(still, Set(1), move)));
    // Rounding may have led to the face before or behind.
    index = hn::Sub(hn::Add(hn::Mul(hn::ConvertTo(df, lower), Set(edge)), ahead), turn);
    SetFace();
    PassTo(from);
    PassTo(from);
  }

  /// Returns the lower of the two faces around the ray, in voxels: -edge before the first voxel.
  HWY_INLINE VF Lower() const { return hn::Sub(index, ahead); }

  HWY_INLINE void PassTo(VF place) {
    index = hn::IfThenElse(hn::Le(face, place), hn::Add(index, turn), index);
    SetFace();
  }

 private:
  HWY_INLINE void SetFace() { face = hn::Mul(hn::Sub(index, start), inverse); }
};

/// The path of a packet's rays through boxes of cells. A walk may begin at a face or at a ray's start. What
/// it meets is the same to the last bit either way.
struct FaceWalk {
  Faces x, y, z;
  VF at;  ///< Position on each ray, in steps from its start.

  HWY_INLINE FaceWalk(const Packet& p, VF from, float edge)
      : x(p.start.x, p.move.x, from, edge),
        y(p.start.y, p.move.y, from, edge),
        z(p.start.z, p.move.z, from, edge),
        at(from) {}

  HWY_INLINE VF NextFace() const { return hn::Min(hn::Min(x.face, y.face), z.face); }
  HWY_INLINE void GoTo(VF place) {
    at = place;
    x.PassTo(place);
    y.PassTo(place);
    z.PassTo(place);
  }
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
