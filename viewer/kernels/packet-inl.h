// The rays in one vector. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_PACKET_INL_H_
#undef VOLUMEN_KERNELS_PACKET_INL_H_
#else
#define VOLUMEN_KERNELS_PACKET_INL_H_
#endif

#include <algorithm>

#include "viewer/kernels/math-inl.h"
#include "viewer/kernels/trace.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// The rays of one vector: where they start and how they move.
struct Packet {
  V3 start, move;
  VF steps, ahead;
  VF lastMiddle, unitDistances, lastUnitDistances;  ///< Lengths of a whole step and of the last one.
  int longest = 0;                                  ///< Steps of the longest ray.
};

HWY_INLINE Packet LoadPacket(const RayInputs& f, const RayRow& r, int first) {
  const DF df;
  const auto load = [&](const std::vector<float>& v) { return hn::LoadU(df, v.data() + first); };
  Packet p;
  p.start = {load(r.startX), load(r.startY), load(r.startZ)};
  p.move = {load(r.moveX), load(r.moveY), load(r.moveZ)};
  p.steps = hn::ConvertTo(df, hn::LoadU(DI(), r.steps.data() + first));
  p.ahead = load(r.ahead);
  p.lastMiddle = load(r.lastMiddle);
  p.unitDistances = hn::Mul(load(r.stepMm), Set(f.inverseUnitMm));
  p.lastUnitDistances = hn::Mul(load(r.lastStepMm), Set(f.inverseUnitMm));
  p.longest = *std::max_element(r.steps.data() + first, r.steps.data() + first + hn::Lanes(df));
  return p;
}

/// Returns the index of each ray's sample at a step of the block. Rays that begin later or have ended have no
/// sample there (HasSample).
HWY_INLINE VF SampleAt(const Packet& p, int step) { return hn::Sub(Set(float(step)), p.ahead); }
HWY_INLINE MF HasSample(const Packet& p, VF n) {
  return hn::And(hn::Ge(n, hn::Zero(DF())), hn::Lt(n, p.steps));
}
HWY_INLINE MF IsLast(const Packet& p, VF n) { return hn::Eq(p.steps, hn::Add(n, Set(1))); }

/// Returns start + (n + 1/2) move (picture.md 9); the last interval is shorter.
HWY_INLINE V3 Position(const Packet& p, VF n, MF last) {
  const VF middle = hn::IfThenElse(last, p.lastMiddle, hn::Add(n, Set(0.5f)));
  return Add(p.start, Scale(p.move, middle));
}

/// Returns the same as Position(), for samples that are not the last of their ray.
HWY_INLINE V3 PositionBefore(const Packet& p, VF n) {
  return Add(p.start, Scale(p.move, hn::Add(n, Set(0.5f))));
}
/// Returns true if every ray of `which` has a sample at each of `count` steps from `step` on, none of them
/// its last.
HWY_INLINE bool GoOn(const Packet& p, MF which, int step, int count) {
  const MF begun = hn::Ge(SampleAt(p, step), hn::Zero(DF())),
           goOn = hn::Lt(SampleAt(p, step + count), p.steps);
  return hn::AllTrue(DF(), hn::Or(hn::Not(which), hn::And(begun, goOn)));
}

/// Returns the move of each ray per step, in voxels.
HWY_INLINE V3 MoveOf(const RayRow& rays, VI ray) {
  const DF df;
  if (rays.parallel) return Broadcast(rays.sharedMove);
  return {hn::GatherIndex(df, rays.moveX.data(), ray), hn::GatherIndex(df, rays.moveY.data(), ray),
          hn::GatherIndex(df, rays.moveZ.data(), ray)};
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
