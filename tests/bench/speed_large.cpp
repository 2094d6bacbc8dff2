#include <algorithm>

#include "tests/bench/speed.h"
#include "viewer/evaluation/statistics.h"
#include "viewer/phantoms/phantom_head.h"
#include "viewer/volume/clock.h"
#include "viewer/volume/gradient_bounds.h"
#include "viewer/volume/histogram.h"

namespace volumen::bench {

namespace {

constexpr int slices = 300;

// Returns the head phantom interpolated to `slices` slices.
Result<VolumePtr> largeHead() {
  VolumeParts parts = headPhantom(512);
  const auto& from = std::get<std::vector<std::int16_t>>(parts.values);
  const std::int64_t slice = std::int64_t(parts.geometry.size.x) * parts.geometry.size.y;
  const double scale = double(parts.geometry.size.z - 1) / (slices - 1);
  std::vector<std::int16_t> to(std::size_t(slice) * slices);
  for (int k = 0; k < slices; ++k) {
    const int below = std::min(int(k * scale), parts.geometry.size.z - 2);
    const double part = k * scale - below;
    for (std::int64_t n = 0; n < slice; ++n)
      to[k * slice + n] =
          std::int16_t((1 - part) * from[below * slice + n] + part * from[(below + 1) * slice + n]);
  }
  parts.geometry.size.z = slices;
  parts.geometry.patientFromVoxelStep[2] *= scale;
  parts.values = std::move(to);
  std::vector<std::string> warnings;
  return Volume::make(std::move(parts), warnings);
}

struct FirstPicture {
  std::vector<double> wholeMs, blocksMs, gradientsMs;
  RenderStats stats;  ///< statistics of the last picture
};

Result<FirstPicture> firstPictures(const SpeedInputs& in, const VolumePtr& volume, const Scene& scene) {
  FirstPicture first;
  for (int round = 0; round < in.rounds; ++round) {
    RenderCaches caches(volume);
    const auto orbit = measureOrbit(scene, plainSteps(in.threads), {.views = 1, .rounds = 1}, caches);
    if (!orbit) return orbit.error();
    first.wholeMs.push_back(orbit->firstFrameMs);
    first.gradientsMs.push_back(orbit->gradientsMs);
    first.stats = orbit->views[0].stats;
    const double begin = wallMs();
    gradientBoundsOf(*volume, blockRanges(*volume), valueRange(*volume));
    first.blocksMs.push_back(wallMs() - begin);
  }
  return first;
}

std::vector<Goal> firstPictureGoals(const FirstPicture& first) {
  const double whole = minimum(first.wholeMs), passes = minimum(first.gradientsMs) + minimum(first.blocksMs);
  return {{"first picture after decoding", text("%.0f ms", whole), "<= 1 s", whole <= 1000},
          {"of it gradients and copies, blocks and slopes",
           text("%.0f + %.0f ms", minimum(first.gradientsMs), minimum(first.blocksMs)), "<= 250 ms",
           passes <= 250}};
}

Goal memoryGoal(const char* what, const RenderStats& s, std::int64_t voxels) {
  const double rest = double(s.blockBytes + s.tableBytes), kept = double(s.densityBytes + s.gradientBytes);
  return {what,
          text("a voxel %.0f B density, %.0f B gradients; the rest %.1f %%",
               double(s.densityBytes) / double(voxels), double(s.gradientBytes) / double(voxels),
               100 * rest / kept),
          "< 3 %", rest / kept < 0.03};
}

// Times a curve edit up to the first sample: plan, curve table and blocks, without the pass over the rays.
Result<Goal> opacityEdit(const SpeedInputs& in, RenderCaches& caches, Scene scene) {
  std::vector<double> planMs, restMs, allMs;
  for (int n = 0; n <= 4 * in.rounds; ++n) {
    // The second last point moves, and with it what is visible.
    CurvePoint& point = scene.transferFunction.points[scene.transferFunction.points.size() - 2];
    point.value += float(n % 2 ? 10 : -10);
    const double begin = wallMs();
    const auto plan = makePlan(scene, caches.facts(), plainSteps(in.threads));
    if (!plan) return plan.error();
    const double planned = wallMs() - begin;
    const auto done = render(*plan, caches);
    if (!done) return done.error();
    if (n == 0) continue;  // warm-up
    planMs.push_back(planned);
    restMs.push_back(done->stats.totalMs - done->stats.resampleMs - done->stats.shadeMs);
    allMs.push_back(planned + restMs.back());
  }
  return Goal{
      "opacity edit: before the first sample",
      text("%.1f ms (plan %.1f, tables and blocks %.1f)", minimum(allMs), minimum(planMs), minimum(restMs)),
      "<= 3 ms", minimum(allMs) <= 3};
}

}  // namespace

Result<std::vector<Goal>> measureLargeVolume(const SpeedInputs& in) {
  const auto volume = largeHead();
  if (!volume) return volume.error();
  const std::int64_t voxels = (*volume)->geometry().voxelCount();
  Scene scene = in.scenes.front().scene;
  scene.shading.lit = true;
  const auto first = firstPictures(in, *volume, scene);
  if (!first) return first.error();
  std::vector<Goal> goals = firstPictureGoals(*first);
  goals.push_back(memoryGoal("memory, lit", first->stats, voxels));
  RenderCaches caches(*volume);
  const auto edit = opacityEdit(in, caches, scene);
  if (!edit) return edit.error();
  goals.insert(goals.begin(), *edit);
  scene.shading.lit = false;
  RenderCaches unlitCaches(*volume);
  const auto unlit = measureOrbit(scene, plainSteps(in.threads), {.views = 1, .rounds = 1}, unlitCaches);
  if (!unlit) return unlit.error();
  goals.push_back(memoryGoal("memory, unlit", unlit->views[0].stats, voxels));
  for (Goal& g : goals) g.what = "512 x 512 x 300: " + g.what;
  return goals;
}

}  // namespace volumen::bench
