// Skips samples that cannot change an extreme. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_SKIP_SAMPLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_SKIP_SAMPLES_INL_H_
#undef VOLUMEN_KERNELS_SKIP_SAMPLES_INL_H_
#else
#define VOLUMEN_KERNELS_SKIP_SAMPLES_INL_H_
#endif

#include "viewer/kernels/bytes-inl.h"
#include "viewer/kernels/empty_space-inl.h"
#include "viewer/kernels/project.h"
#include "viewer/kernels/projection-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// The code below searches for the largest value; minima are negated.
template <Mode kMode>
constexpr double kSign = kMode == Mode::mip ? 1 : -1;

/// Returns the number of grid entries from `first` to `last`, inclusive; a float because it may be large.
inline float CountBetween(glm::ivec3 first, glm::ivec3 last) {
  const glm::vec3 count(last - first + 1);
  return count.x * count.y * count.z;
}

/// Returns a bound on all samples in the blocks around a box; infinite if there are more than `mostBlocks`.
template <Mode kMode>
double MostInBlocks(const BlockValues& blocks, const Box& box, int mostBlocks) {
  const BlockRanges& b = *blocks.blockRanges;
  const glm::ivec3 first = glm::ivec3(box.low) / b.edge, last = glm::ivec3(box.high) / b.edge;
  if (CountBetween(first, last) > float(mostBlocks)) return std::numeric_limits<double>::infinity();
  std::uint8_t level = kMode == Mode::mip ? 0 : 255;
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const std::size_t n = (std::size_t(z) * b.count.y + y) * b.count.x + x;
        level = kMode == Mode::mip ? std::max(level, b.highest[n]) : std::min(level, b.lowest[n]);
      }
  const float most = float(kSign<kMode>) * b.levels[level];
  const double density = kSign<kMode> * (kSign<kMode> * most - blocks.intercept) / blocks.slope;
  return blocks.whole ? std::floor(density + 0.5 + blocks.off) : density + blocks.off;
}

template <class Store>
float VoxelOf(const RayInputs& f, std::size_t n) {
  if constexpr (std::is_same_v<Store, Int16Store>)
    return std::int16_t(f.density16[n] ^ std::int16_t(f.flip16));
  else if constexpr (std::is_same_v<Store, Byte1Store>)
    return f.density8[n];
  else
    return f.density32[n];
}

/// Returns a bound on all samples in a box; infinite if it holds more than `mostVoxels` voxels.
template <class Store, Mode kMode>
double MostInBox(const RayInputs& f, const BlockValues& blocks, const Box& box, int mostVoxels) {
  const glm::ivec3 first(box.low), last = glm::min(glm::ivec3(box.high) + 1, f.size - 1);
  if (CountBetween(first, last) > float(mostVoxels)) return std::numeric_limits<double>::infinity();
  float most = -std::numeric_limits<float>::max();
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y) {
      const std::size_t row = (std::size_t(z) * f.size.y + y) * f.size.x;
      for (int x = first.x; x <= last.x; ++x)
        most = std::max(most, float(kSign<kMode>) * VoxelOf<Store>(f, row + x));
    }
  // Interpolation between whole numbers never exceeds them.
  return blocks.whole ? double(most) : most + blocks.off;
}

/// A run of steps of a packet, and a bound on its samples.
struct SampleRun {
  double most;
  int begin, end;
  int middle() const { return (begin + end) / 2; }
  bool operator<(const SampleRun& other) const { return most < other.most; }
};

/// Takes the samples that may change the extremes. First takes one sample of each run. Then takes runs by
/// descending bound until no bound exceeds the extremes met by all rays. The order does not change an
/// extreme. Returns the number of samples taken.
template <class Store, Mode kMode>
std::int64_t TakeExtremes(const RayInputs& f, const BlockValues& blocks, SampleProjection<Store, kMode>& rays,
                          std::vector<SampleRun>& runs) {
  const Packet& p = rays.Rays();
  const DF df;
  const VF fastest = hn::Max(hn::Abs(p.move.x), hn::Max(hn::Abs(p.move.y), hn::Abs(p.move.z)));
  const float aStep = hn::GetLane(hn::MaxOfLanes(df, fastest));
  const auto stepsIn = [&](float voxels) { return int(std::clamp(voxels / aStep, 1.0f, 64.0f)); };
  // Longer runs hold too much; shorter ones cost as much to test as to sample. The same holds for more blocks
  // or voxels per step, where pixels lie far apart.
  const int length = stepsIn(8), part = stepsIn(2), voxelsAStep = 16,
            blocksAStep = blocks.blockRanges->edge < 4 ? voxelsAStep : 2;
  const EmptySpaceSkipper around(f, p);
  const auto boxOf = [&](int begin, int end) {
    Box box;
    around.TakeIn(begin, end - begin, box);
    return box;
  };
  const auto reached = [&] { return kSign<kMode> * double(rays.ReachedByAll()); };
  std::int64_t taken = 0;
  runs.clear();
  for (int begin = 0; begin < p.longest; begin += length) {
    const int end = std::min(begin + length, p.longest);
    runs.push_back({MostInBlocks<kMode>(blocks, boxOf(begin, end), blocksAStep * (end - begin)), begin, end});
    taken += rays.Take(runs.back().middle());
  }
  std::make_heap(runs.begin(), runs.end());
  for (; !runs.empty() && runs.front().most > reached(); runs.pop_back()) {
    const SampleRun most = runs.front();
    for (int begin = most.begin; begin < most.end; begin += part) {
      const int end = std::min(begin + part, most.end);
      if (MostInBox<Store, kMode>(f, blocks, boxOf(begin, end), voxelsAStep * (end - begin)) <= reached())
        continue;
      for (int step = begin; step < end; ++step)
        if (step != most.middle()) taken += rays.Take(step);
    }
    std::pop_heap(runs.begin(), runs.end());
  }
  return taken;
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
