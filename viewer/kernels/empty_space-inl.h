// Empty-space skipping: passes over blocks that hold nothing visible. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_EMPTY_SPACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_EMPTY_SPACE_INL_H_
#undef VOLUMEN_KERNELS_EMPTY_SPACE_INL_H_
#else
#define VOLUMEN_KERNELS_EMPTY_SPACE_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "viewer/kernels/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// Looks up boxes of blocks that start at `index` and extend `across` blocks farther. Returns non-zero where
/// a box meets a visible block. `layer`: start of the map's layer, 0 or from EmptySpaceMap::layerAt.
HWY_INLINE VI NearBlocks(const EmptySpaceMap& map, const VI (&index)[3], const VI (&across)[3], VI layer) {
  const DI di;
  const VI row = hn::Add(hn::Mul(index[2], SetI(map.count.y)), index[1]);
  const auto farther = [&](int a) { return hn::ShiftLeftSame(hn::Min(across[a], SetI(1)), a); };
  const VI block = hn::Add(hn::Mul(row, SetI(map.rowBlocks())), index[0]);
  const auto isFar = hn::Gt(layer, hn::Zero(di));
  const VI at = hn::IfThenElse(isFar, hn::Add(layer, hn::ShiftRight<3>(block)), block);
  const VI bit =
      hn::IfThenElse(isFar, hn::And(block, SetI(7)), hn::Or(farther(0), hn::Or(farther(1), farther(2))));
  const auto* base = reinterpret_cast<const std::int32_t*>(map.near.data());
  return hn::And(hn::GatherOffset(di, base, at), hn::Shl(SetI(1), bit));
}

/// A box of positions in voxels; empty at first.
struct Box {
  glm::vec3 low{std::numeric_limits<float>::max()}, high{0};
};

/// Returns how many steps one look of an EmptySpaceSkipper covers: 4, 2 or 1, together at most `voxels` long
/// if more than one.
inline int StepsALook(const RayRow& rays, float voxels) {
  for (std::size_t n = 0; n < rays.steps.size(); ++n)
    if (rays.steps[n] > 0) {
      const float step = glm::length(glm::vec3(rays.moveX[n], rays.moveY[n], rays.moveZ[n]));
      return 4 * step <= voxels ? 4 : 2 * step <= voxels ? 2 : 1;
    }
  return 1;
}

/// Finds the steps at which a packet must be sampled. One look into the map, at the lower corner of the box
/// around the rays, serves all of them (EmptySpaceMap). Packets that spread wider than the map reaches are
/// sampled everywhere.
class EmptySpaceSkipper {
 public:
  EmptySpaceSkipper(const RayInputs& f, const Packet& p, int stepsALook = 1)
      : map_(f.skip),
        stepsALook_(stepsALook),
        middleLayer_(map_ ? int(map_->layerAt(1)) : 0),
        lastLayer_(map_ ? int(map_->layerAt(map_->layers() - 1)) : 0) {
    const DF df;
    const MF real = hn::Gt(p.steps, hn::Zero(df));
    if (hn::AllFalse(df, real)) {
      map_ = nullptr;
      return;
    }
    const float from = RangeOf(p.ahead, real).low, to = RangeOf(hn::Add(p.ahead, p.steps), real).high;
    const VF start[3] = {p.start.x, p.start.y, p.start.z}, move[3] = {p.move.x, p.move.y, p.move.z};
    for (int a = 0; a < 3; ++a) {
      const auto rangeAt = [&](float step) {
        return RangeOf(hn::Add(start[a], hn::Mul(move[a], hn::Sub(Set(step), p.ahead))), real);
      };
      // Between the ends of the packet its rays are nowhere farther apart than at one of them.
      const Range begin = rangeAt(from), end = rangeAt(to);
      const float half = 0.5f * std::max(begin.high - begin.low, end.high - end.low);
      const float middle = 0.5f * (begin.low + begin.high);
      move_[a] = (0.5f * (end.low + end.high) - middle) / (to - from);
      // Intervals reach half a step to either side. The last sample of a ray stands up to half a step before
      // its place in the row. A hundredth of a voxel is far more than the rounding of positions.
      const float back = 0.5f * std::abs(move_[a]) + 0.01f;
      size_[a] = 2 * half + 2 * back;
      start_[a] = middle - half - back - from * move_[a];
      last_[a] = float(f.size[a] - 1);
      const float along = float(stepsALook - 1) * move_[a];
      lookStart_[a] = start_[a] + std::min(along, 0.0f);
      lookSize_[a] = size_[a] + std::abs(along);
      if (map_ && lookSize_[a] > float(map_->reach << map_->shift)) map_ = nullptr;
    }
  }

  /// Returns how far the packet moves in `steps` steps, in voxels.
  glm::vec3 MoveOf(int steps) const { return float(steps) * glm::vec3(move_[0], move_[1], move_[2]); }

  /// Extends the box to hold the packet at the steps [step, step + count), clamped to the grid.
  HWY_INLINE void TakeIn(int step, int count, Box& box) const {
    for (int a = 0; a < 3; ++a) {
      const float first = start_[a] + (float(step) + 0.5f) * move_[a],
                  last = first + float(count - 1) * move_[a];
      box.low[a] = std::min(box.low[a], std::clamp(std::min(first, last), 0.0f, last_[a]));
      box.high[a] = std::max(box.high[a], std::clamp(std::max(first, last) + size_[a], 0.0f, last_[a]));
    }
  }

  int stepsALook() const { return stepsALook_; }

  /// The first and last voxel of the box around the packet along axis `a`, clamped to the grid. One lane per
  /// step, from `step` on.
  struct Voxels {
    VI low, high;
  };
  HWY_INLINE Voxels VoxelsFrom(int step, int a) const {
    const VF middle = hn::Add(hn::Iota(DF(), 0), Set(float(step) + 0.5f));
    const VF low = hn::Add(Set(start_[a]), hn::Mul(middle, Set(move_[a])));
    return {VoxelAt(a, low), VoxelAt(a, hn::Add(low, Set(size_[a])))};
  }

  /// Returns one bit per step, from `step` on: as many as the lanes of stepsALook vectors.
  HWY_INLINE std::uint64_t LookFrom(int step) const {
    const DF df;
    const DI di;
    if (!map_) return ~std::uint64_t(0) >> (64 - int(hn::Lanes(df)) * stepsALook_);
    const VF looks = hn::Mul(hn::Iota(df, 0), Set(float(stepsALook_)));
    const VF middle = hn::Add(hn::Add(looks, Set(float(step))), Set(0.5f));
    const auto block = [&](int a, VF x) { return hn::ShiftRightSame(VoxelAt(a, x), map_->shift); };
    VI index[3], across[3];
    for (int a = 0; a < 3; ++a) {
      const VF x = hn::Add(Set(lookStart_[a]), hn::Mul(middle, Set(move_[a])));
      index[a] = block(a, x);
      across[a] = hn::Sub(block(a, hn::Add(x, Set(lookSize_[a]))), index[a]);
    }
    const VI farthest = hn::Max(across[0], hn::Max(across[1], across[2]));
    const auto layerWhere = [&](int more, int layer) {
      return hn::IfThenElseZero(hn::Gt(farthest, SetI(more)), SetI(layer));
    };
    const VI layer = hn::Max(layerWhere(1, middleLayer_), layerWhere(map_->reach - 1, lastLayer_));
    const VI seen = NearBlocks(*map_, index, across, layer);
    alignas(8) std::uint8_t bits[8] = {};
    hn::StoreMaskBits(di, hn::Ne(seen, hn::Zero(di)), bits);
    std::uint64_t mask;
    std::memcpy(&mask, bits, 8);
    mask &= (std::uint64_t(1) << hn::Lanes(df)) - 1;
    for (int n = 1; n < stepsALook_; n *= 2) mask = EachTwice(mask);
    return mask;
  }

 private:
  struct Range {
    float low, high;
  };
  static HWY_INLINE Range RangeOf(VF v, MF of) {
    const DF df;
    return {hn::GetLane(hn::MinOfLanes(df, hn::IfThenElse(of, v, Set(1e30f)))),
            hn::GetLane(hn::MaxOfLanes(df, hn::IfThenElse(of, v, Set(-1e30f))))};
  }

  HWY_INLINE VI VoxelAt(int a, VF x) const {
    return Truncated(hn::Min(hn::Max(x, hn::Zero(DF())), Set(last_[a])));
  }

  /// Doubles every bit of the lower half.
  static HWY_INLINE std::uint64_t EachTwice(std::uint64_t bits) {
    bits = (bits | bits << 16) & 0x0000ffff0000ffffu;
    bits = (bits | bits << 8) & 0x00ff00ff00ff00ffu;
    bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0fu;
    bits = (bits | bits << 2) & 0x3333333333333333u;
    bits = (bits | bits << 1) & 0x5555555555555555u;
    return bits | bits << 1;
  }

  const EmptySpaceMap* map_;
  int stepsALook_;
  int middleLayer_, lastLayer_;  ///< Offsets of the layers in the map.
  float start_[3] = {}, size_[3] = {}, move_[3] = {}, last_[3] = {};
  float lookStart_[3] = {}, lookSize_[3] = {};  ///< Box of all steps of one look together.
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
