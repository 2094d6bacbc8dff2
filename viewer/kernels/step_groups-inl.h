// Takes the rays of a row through groups of steps. Compiled once per CPU target.
#if defined(VOLUMEN_KERNELS_STEP_GROUPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLUMEN_KERNELS_STEP_GROUPS_INL_H_
#undef VOLUMEN_KERNELS_STEP_GROUPS_INL_H_
#else
#define VOLUMEN_KERNELS_STEP_GROUPS_INL_H_
#endif

#include <algorithm>
#include <limits>

#include "viewer/kernels/cells-inl.h"
#include "viewer/kernels/classify_and_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace volumen::HWY_NAMESPACE {

/// The steps [begin, end) that any ray of a row takes.
struct StepRange {
  int begin, end;
};
inline StepRange StepsOf(const RayRow& rays) {
  float begin = std::numeric_limits<float>::max(), end = 0;
  for (std::size_t n = 0; n < rays.steps.size(); ++n)
    if (rays.steps[n] > 0) {
      begin = std::min(begin, rays.ahead[n]);
      end = std::max(end, rays.ahead[n] + float(rays.steps[n]));
    }
  return end > 0 ? StepRange{int(begin), int(std::ceil(end))} : StepRange{0, 0};
}

/// Early ray termination: returns true if any ray of the packet at ray `first` still lets light through and
/// has samples at the steps [step, end). Rays from the back always let light through.
HWY_INLINE bool IsPacketOpen(const RayInputs& f, const RayRow& rays, const TraceRow& out, int first, int step,
                             int end) {
  const DF df;
  const VF ahead = hn::LoadU(df, rays.ahead.data() + first),
           steps = hn::ConvertTo(df, hn::LoadU(DI(), rays.steps.data() + first));
  const MF has = hn::And(hn::Gt(hn::Add(ahead, steps), Set(float(step))), hn::Lt(ahead, Set(float(end))));
  if (f.slices.fromBack) return !hn::AllFalse(df, has);
  const MF open = hn::Le(hn::LoadU(df, out.alpha + first), Set(1 - f.stopTransmittance));
  return !hn::AllFalse(df, hn::And(has, open));
}

/// Takes all packets of the row through groups of steps, from the front or from the back (RayInputs::slices).
/// Packets share the cache lines that one of them loads. A single packet marching across rows of 512 voxels
/// evicts its own cache lines, which are a power of two apart. `ends` holds, for each packet, the step from
/// which on nothing is sampled.
template <class Tracer>
void TakeStepGroups(const RayInputs& f, const RayRow& rays, const PlaneBuffer& plane, const TraceRow& out,
                    TraceCounts& counts, const std::vector<EmptySpaceSkipper>& skippers, StepRange steps,
                    const std::vector<int>& ends) {
  Tracer tracer(f, rays, plane, out, counts);
  const int lanes = int(hn::Lanes(DF())), packets = int(skippers.size());
  constexpr int group = Tracer::kGroupSteps;
  // One look covers the steps of several groups, or part of a group.
  const int look = lanes * skippers.front().stepsALook(), looked = std::max(look, group);
  std::vector<std::uint64_t> looks(packets), bits(packets);
  const auto isOpen = [&](int n, int from, int to) {
    return IsPacketOpen(f, rays, out, n * lanes, from, to);
  };
  const auto lookFrom = [&](int n, int step) {
    const int wanted = std::clamp(ends[n] - step, 0, looked);
    std::uint64_t seen = 0;
    if (wanted && isOpen(n, step, step + looked))
      for (int more = 0; more < looked; more += look) seen |= skippers[n].LookFrom(step + more) << more;
    return wanted ? seen & ~std::uint64_t(0) >> (64 - wanted) : 0;
  };
  const int start = steps.begin / looked * looked, groups = (steps.end - start + group - 1) / group;
  const int ahead = f.slices.fromBack ? -group : group;
  for (int k = 0; k < groups; ++k) {
    const int step = start + group * (f.slices.fromBack ? groups - 1 - k : k), within = step % looked;
    const bool isNew = k == 0 || within == (f.slices.fromBack ? looked - group : 0);
    Box box;
    for (int n = 0; n < packets; ++n) {
      if (isNew) looks[n] = lookFrom(n, step - within);
      bits[n] = looks[n] >> within & ((1 << group) - 1);
      if (bits[n] && !isOpen(n, step, step + group)) bits[n] = 0;
      if (Tracer::kCells && bits[n]) skippers[n].TakeIn(step, group, box);
    }
    if (Tracer::kCells && box.low.x <= box.high.x) {
      f.cells->lookInto(box.low, box.high);
      const glm::vec3 next = skippers.front().MoveOf(group);
      f.cells->prefetch(box.low + next, box.high + next);
    }
    tracer.BeginGroup();
    for (int n = 0; n < packets; ++n) {
      if constexpr (Tracer::kPrefetches)
        if (bits[n]) {
          Box next;
          skippers[n].TakeIn(step + ahead, group, next);
          tracer.Prefetch(next.low, next.high);
        }
      tracer.Advance(skippers[n], n * lanes, step, bits[n]);
    }
    tracer.EndGroup();
  }
  tracer.Finish();
}

/// Returns the last visible step of each ray, -1 if there is none. Follows all rays from the front, without
/// light, until they are opaque.
template <class Tracer>
std::vector<float> ShownSteps(const RayInputs& f, const RayRow& rays, const PlaneBuffer& plane,
                              const std::vector<EmptySpaceSkipper>& skippers, StepRange steps,
                              TraceCounts& counts) {
  RayInputs front = f;
  front.slices = {};
  const std::size_t count = rays.steps.size();
  std::vector<float> shown(count, -1), pixels(4 * count);
  float* p = pixels.data();
  const TraceRow row{p, p + count, p + 2 * count, p + 3 * count, nullptr, shown.data()};
  TraceCounts looked;
  const std::vector<int> ends(skippers.size(), steps.end);
  TakeStepGroups<typename Tracer::Unlit>(front, rays, plane, row, looked, skippers, steps, ends);
  counts.resampled += looked.resampled;
  return shown;
}

/// Traces the rays of a row; one instance is one kernel.
template <class Tracer>
void TraceRays(const RayInputs& f, const RayRow& rays, const PlaneBuffer& plane, const TraceRow& out,
               TraceCounts& counts) {
  const std::int64_t begin = Ticks();
  const int lanes = int(hn::Lanes(DF())), packets = int(rays.steps.size()) / lanes;
  std::vector<EmptySpaceSkipper> skippers;
  skippers.reserve(packets);
  // Where cells are tested too, a look that finds too much costs little.
  const int stepsALook = StepsALook(rays, Tracer::kCells ? EmptySpaceMap::longestLook : 1);
  for (int n = 0; n < packets; ++n) skippers.emplace_back(f, LoadPacket(f, rays, n * lanes), stepsALook);
  const StepRange steps = StepsOf(rays);
  std::vector<int> ends(packets, steps.end);
  std::vector<float> shown;
  if constexpr (Tracer::kBlends)
    if (f.slices.fromBack && f.stopTransmittance > 0) {
      shown = ShownSteps<Tracer>(f, rays, plane, skippers, steps, counts);
      for (int n = 0; n < packets; ++n)
        ends[n] = 1 + int(*std::max_element(&shown[n * lanes], &shown[n * lanes] + lanes));
    }
  const TraceRow row{out.red,   out.green, out.blue,
                     out.alpha, out.error, shown.empty() ? nullptr : shown.data()};
  TakeStepGroups<Tracer>(f, rays, plane, row, counts, skippers, steps, ends);
  counts.allTicks += Ticks() - begin;
}

}  // namespace volumen::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
