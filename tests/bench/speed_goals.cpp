#include <algorithm>

#include "tests/bench/speed.h"
#include "viewer/evaluation/statistics.h"
#include "viewer/kernels/make_reflectance_map.h"
#include "viewer/paper/paper.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/segment/occupancy.h"
#include "viewer/segment/range.h"
#include "viewer/volume/clock.h"

namespace volumen::bench {

namespace {

Status drawRounds(std::vector<Case>& cases, int rounds) {
  for (int round = 0; round < rounds; ++round)
    if (Status s = drawRound(cases); !s) return s;
  return {};
}

// The paper's own scene: a sphere of ever more voxels of 1 mm, with a hundred samples across the volume.
// Opacity is relative to the volume's width, so that a sample is equally opaque in each.
Result<Goal> opaqueSpheres(const SpeedInputs& in) {
  const Scene paper = paperPhantoms().back().scene;
  std::vector<std::unique_ptr<RenderCaches>> caches;
  std::vector<Case> cases;
  for (const int edge : {32, 64, 128, 256}) {
    const auto volume = makePhantom("opaque-sphere:" + std::to_string(edge));
    if (!volume) return volume.error();
    caches.push_back(std::make_unique<RenderCaches>(*volume));
    RenderOptions options = plainSteps(in.threads);
    options.step = edge / 100.0;
    Scene scene = paper;
    scene.transferFunction.unitDistance *= edge / 64.0;
    cases.push_back({std::to_string(edge), scene, options, caches.back().get()});
  }
  if (Status s = drawRounds(cases, 2 * in.rounds); !s) return s.error();
  Goal goal{"opaque sphere as 32³, 64³, 128³, 256³ voxels, same samples", {}, "within 15 %"};
  std::vector<double> ms;
  for (const Case& c : cases) {
    ms.push_back(msOf(c));
    goal.measured += text("%s%.1f", ms.size() > 1 ? ", " : "", ms.back());
  }
  const auto [least, most] = std::minmax_element(ms.begin(), ms.end());
  goal.measured += text(" ms: %.2f x", *most / *least);
  goal.reached = *most / *least <= 1.15;
  return goal;
}

Result<std::vector<Goal>> oneAndTwoThreads(const SpeedInputs& in, RenderCaches& caches) {
  std::vector<Case> cases;
  for (const NamedScene& s : in.scenes)
    for (const int threads : {1, 2}) cases.push_back({s.name, s.scene, plainSteps(threads), &caches});
  if (Status s = drawRounds(cases, in.rounds); !s) return s.error();
  std::vector<Goal> goals;
  for (std::size_t n = 0; n < cases.size(); n += 2) {
    const double efficiency = msOf(cases[n]) / msOf(cases[n + 1]) / 2;
    goals.push_back({"1 to 2 threads, " + cases[n].name,
                     text("%.0f to %.0f ms: efficiency %.2f", msOf(cases[n]), msOf(cases[n + 1]), efficiency),
                     ">= 0.9", efficiency >= 0.9});
  }
  return goals;
}

// Times making the table of a reflectance map of the default size.
Goal lightEdit(const Plan& whole, int lights) {
  Scene lit = whole.scene;
  lit.lights = ringOfLights(lights);
  std::vector<double> ms;
  for (int n = 0; n < 31; ++n) {
    lit.lights[0].direction.x += 0.01;
    const double begin = wallMs();
    const ReflectanceMap map =
        makeReflectanceMap(makeLighting(lit, true, whole.colouredLight), whole.mapSize, MapLookup::bilinear);
    ms.push_back(wallMs() - begin);
  }
  return {text("light edit, %d light%s: the shading table", lights, lights > 1 ? "s" : ""),
          text("%.1f ms", minimum(ms)), "<= 2 ms", minimum(ms) <= 2};
}

Result<std::vector<Goal>> lights(const SpeedInputs& in, RenderCaches& caches) {
  RenderOptions byMap;
  byMap.shader = Shader::map;
  const auto whole = makePlan(in.scenes.front().scene, caches.facts(), byMap);
  if (!whole) return whole.error();
  std::vector<Goal> goals{lightEdit(*whole, 1), lightEdit(*whole, 16)};
  std::vector<Case> cases;
  for (const int count : {1, 16}) {
    Case c{in.scenes.front().name, whole->scene, {}, &caches};
    c.options.threads = in.threads;
    c.scene.lights = ringOfLights(count);
    cases.push_back(std::move(c));
  }
  if (Status s = drawRounds(cases, in.rounds); !s) return s.error();
  const double ratio = msOf(cases[1]) / msOf(cases[0]);
  goals.push_back({"frame with 16 lights against 1, standard quality",
                   text("%.0f against %.0f ms: %.2f x", msOf(cases[1]), msOf(cases[0]), ratio), "<= 1.10 x",
                   ratio <= 1.10});
  return goals;
}

Result<Goal> litAndUnlit(const SpeedInputs& in, RenderCaches& caches) {
  const NamedScene& named = in.scenes.front();
  std::vector<Case> cases(2, {named.name, named.scene, plainSteps(in.threads), &caches});
  cases[1].scene.shading.lit = false;
  if (Status s = drawRounds(cases, in.rounds); !s) return s.error();
  const double ratio = msOf(cases[0]) / msOf(cases[1]);
  return Goal{named.name + ", unlit against lit",
              text("%.0f against %.0f ms: %.2f x as fast", msOf(cases[1]), msOf(cases[0]), ratio), ">= 1.8 x",
              ratio >= 1.8};
}

// Returns the opaque surface of everything above 226 HU in the right half of the volume.
SegmentSurface halfTheBone(const Volume& volume) {
  BitMask bone = voxelsInRange(volume, {226, 1e30});
  for (int k = 0; k < bone.size().z; ++k)
    for (int j = 0; j < bone.size().y; ++j)
      for (int i = bone.size().x / 2; i < bone.size().x; ++i) bone.set({i, j, k}, false);
  return {std::make_shared<const OccupancyField>(occupancyOf(bone, surfaceSigma)), {0.9, 0.3, 0.2}, 1};
}

Result<std::vector<Goal>> segments(const SpeedInputs& in, RenderCaches& caches) {
  const NamedScene& named = in.scenes.front();
  Case alone{named.name, named.scene, {}, &caches};
  alone.options.threads = in.threads;
  std::vector<Case> cases(2, alone);
  cases[1].scene.segments = {halfTheBone(*in.volume)};
  if (Status s = drawRounds(cases, in.rounds); !s) return s.error();
  const double ratio = msOf(cases[1]) / msOf(cases[0]);
  return std::vector<Goal>{
      {named.name + " with an opaque segment, half the bone, against it alone, standard quality",
       text("%.0f against %.0f ms: %.2f x", msOf(cases[1]), msOf(cases[0]), ratio), "<= 1.3 x",
       ratio <= 1.3}};
}

}  // namespace

Result<std::vector<Goal>> measureGoals(const SpeedInputs& in, RenderCaches& caches) {
  const auto spheres = opaqueSpheres(in);
  if (!spheres) return spheres.error();
  std::vector<Goal> goals{*spheres};
  for (const auto measure : {oneAndTwoThreads, lights, segments}) {
    const auto more = measure(in, caches);
    if (!more) return more.error();
    goals.insert(goals.end(), more->begin(), more->end());
  }
  const auto unlit = litAndUnlit(in, caches);
  if (!unlit) return unlit.error();
  goals.push_back(*unlit);
  return goals;
}

}  // namespace volumen::bench
