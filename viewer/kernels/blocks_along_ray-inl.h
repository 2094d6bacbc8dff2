// Skips blocks that cannot change an extreme. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_BLOCKS_ALONG_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_BLOCKS_ALONG_RAY_INL_H_
#undef VOLUMEN_KERNELS_BLOCKS_ALONG_RAY_INL_H_
#else
#define VOLUMEN_KERNELS_BLOCKS_ALONG_RAY_INL_H_
#endif

#include <cmath>
#include <glm/common.hpp>

#include "viewer/kernels/compact-inl.h"
#include "viewer/kernels/project.h"
#include "viewer/kernels/projection-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// The blocks along the rays of a packet, each with a bound on its density. A block is searched only if its
/// bound exceeds the extreme that its ray has met.
template <Mode kMode>
class BlocksAlongRay {
  using E = Extreme<kMode>;

 public:
  /// `blocks` must hold at least four blocks and outlive this object. `size`: of the volume, in voxels.
  BlocksAlongRay(const BlockValues& blocks, glm::ivec3 size)
      : blockRanges_(*blocks.blockRanges),
        lastCell_(glm::max(size - 2, 0)),
        bytes_(kMode == Mode::mip ? blockRanges_.highest : blockRanges_.lowest) {
    const double sign = kMode == Mode::mip ? 1 : -1;
    for (std::size_t n = 0; n < blockRanges_.levels.size(); ++n) {
      const double most = sign * (blockRanges_.levels[n] - blocks.intercept) / blocks.slope + blocks.off;
      const float rounded = blocks.whole ? float(std::floor(most + 0.5)) : std::nextafter(float(most), 3e38f);
      mostOfLevel_[n] = float(sign) * rounded;
    }
  }

  /// Finds the extremes of a packet from which nothing has been taken yet. Returns the number of passages
  /// taken. The order in which blocks are taken does not change an extreme.
  template <class Store>
  std::int64_t Take(CellProjection<Store, kMode>& rays) {
    Follow(rays.Rays());
    // The block with the highest bound usually holds the extreme.
    VF at = first_.from, to = first_.to;
    std::int64_t taken = rays.Take(at, to, 0);
    for (;;) {
      const int open = Refill(rays.Value(), at, to);
      const bool listed = listed_ == most_.size();
      if (!listed && open <= kLanes / 2) {
        List(rays.Value());
        continue;
      }
      if (open == 0) return taken;
      // Rays that have finished a block wait until half of the rays have.
      taken += rays.Take(at, to, listed && left_ == 0 ? 0 : open / 2);
    }
  }

 private:
  /// Entry and exit of each ray in a block, in steps from the ray's start, and the block's bound.
  struct BlockPassage {
    VF most, from, to;
  };

  void Follow(const Packet& p) {
    const DF df;
    const VF end = EndOf(p), none = Set(E::kNone);
    begin_.clear(), most_.clear();
    listed_ = 0, left_ = 0;
    first_ = {none, hn::Zero(df), hn::Zero(df)};
    FaceWalk walk(p, hn::Zero(df), float(blockRanges_.edge));
    for (MF open = hn::Lt(walk.at, end); !hn::AllFalse(df, open); open = hn::Lt(walk.at, end)) {
      const VF upTo = hn::Min(walk.NextFace(), end), most = hn::IfThenElse(open, MostOf(walk), none);
      const MF more = E::Exceeds(most, first_.most);
      first_ = {hn::IfThenElse(more, most, first_.most), hn::IfThenElse(more, walk.at, first_.from),
                hn::IfThenElse(more, upTo, first_.to)};
      Append(most_, most), Append(begin_, walk.at);
      walk.GoTo(upTo);
    }
    Append(begin_, walk.at);
    for (Queue& q : queues_)
      q.first = q.end = 0, q.parts.resize(std::max(q.parts.size(), most_.size() / kLanes));
  }

  /// Returns a bound on all densities in the blocks around the rays. Beyond the centres of the last voxels it
  /// uses the blocks of the preceding cells, because interpolation reads those.
  HWY_INLINE VF MostOf(const FaceWalk& walk) const {
    const DI di;
    const auto block = [&](VF lower, int lastCell) {
      const VF cell = hn::Min(hn::Max(lower, hn::Zero(DF())), Set(float(lastCell)));
      return Truncated(hn::Mul(cell, Set(1 / float(blockRanges_.edge))));
    };
    const VI row = hn::Add(hn::Mul(block(walk.z.Lower(), lastCell_.z), SetI(blockRanges_.count.y)),
                           block(walk.y.Lower(), lastCell_.y));
    const VI n = hn::Add(hn::Mul(row, SetI(blockRanges_.count.x)), block(walk.x.Lower(), lastCell_.x));
    // Reads four bytes at once, without reading past the last byte.
    const VI from = hn::Min(n, SetI(int(bytes_.size()) - 4));
    const VI four = hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(bytes_.data()), from);
    const VI level = hn::And(hn::Shr(four, hn::ShiftLeft<3>(hn::Sub(n, from))), SetI(255));
    return hn::GatherIndex(DF(), mostOfLevel_, level);
  }

  static void Append(std::vector<float>& to, VF values) {
    to.resize(to.size() + kLanes);
    hn::StoreU(values, DF(), to.data() + to.size() - kLanes);
  }

  /// Queues, for each ray, those of the next few parts whose bound exceeds the extreme met by the ray. The
  /// first part of each ray has been taken already.
  void List(VF met) {
    const DF df;
    const std::size_t end = std::min(most_.size(), listed_ + 16 * kLanes);
    for (; listed_ < end; listed_ += kLanes) {
      const MF other = hn::Ne(hn::LoadU(df, begin_.data() + listed_), first_.from);
      std::uint32_t bits = BitsOf(hn::And(other, E::Exceeds(hn::LoadU(df, most_.data() + listed_), met)));
      for (; bits; bits &= bits - 1, ++left_) {
        const int lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits));
        Queue& q = queues_[lane];
        if (q.first == q.end) q.first = q.end = 0;
        q.parts[q.end++] = int(listed_) + lane;
      }
    }
  }

  /// Sends each idle ray to its next queued part that may hold more than it has met. Directly adjoining parts
  /// are taken together. Returns how many rays are under way.
  int Refill(VF met, VF& at, VF& to) {
    const DF df;
    HWY_ALIGN float value[kLanes], from[kLanes], end[kLanes];
    hn::Store(met, df, value), hn::Store(at, df, from), hn::Store(to, df, end);
    std::uint32_t idle = BitsOf(hn::Ge(at, to));
    int open = kLanes - int(hwy::PopCount(idle));
    for (; idle; idle &= idle - 1) {
      const int lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(idle));
      Queue& q = queues_[lane];
      const auto mayHoldMore = [&](int part) {
        return kMode == Mode::mip ? most_[part] > value[lane] : most_[part] < value[lane];
      };
      const int before = q.first;
      while (q.first < q.end && !mayHoldMore(q.parts[q.first])) ++q.first;
      if (q.first < q.end) {
        int part = q.parts[q.first++];
        from[lane] = begin_[part];
        for (; q.first < q.end && q.parts[q.first] == part + kLanes && mayHoldMore(part + kLanes); ++q.first)
          part += kLanes;
        end[lane] = begin_[part + kLanes];
        ++open;
      }
      left_ -= q.first - before;
    }
    at = hn::Load(df, from), to = hn::Load(df, end);
    return open;
  }

  /// The queued parts of a ray, as indices into most_. Parts before `first` are done.
  struct Queue {
    std::vector<int> parts;
    int first = 0, end = 0;
  };

  const BlockRanges& blockRanges_;
  const glm::ivec3 lastCell_;
  const std::vector<std::uint8_t>& bytes_;
  float mostOfLevel_[BlockRanges::mostLevels] = {};
  std::vector<float> begin_, most_;  ///< One vector per part; begin_ has one more.
  BlockPassage first_;               ///< Part with the highest bound.
  std::size_t listed_ = 0;           ///< Number of entries of most_ that are queued already.
  Queue queues_[kLanes];
  std::int64_t left_ = 0;  ///< Parts left in all queues.
};

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
