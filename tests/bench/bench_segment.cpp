// Times segmentation steps on 512 x 512 x 300 voxels of a synthetic CT. Prints medians of real time (and of
// the work of all cores), on all cores. Goals: threshold and largest part together 250 ms; connected 150 ms
// (5 million voxels); steps with balls of 3 mm 300 ms each; growth from seeds 5 s, in 192^3 voxels 1 s.
#include <benchmark/benchmark.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/bench/often.h"
#include "viewer/segment/brush.h"
#include "viewer/segment/grow_from_seeds.h"
#include "viewer/segment/holes.h"
#include "viewer/segment/morphology.h"
#include "viewer/segment/parts.h"
#include "viewer/segment/range.h"
#include "viewer/segment/table.h"
#include "viewer/volume/parallel.h"

namespace {

using namespace volumen;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Returns HU without noise: a trunk with two lungs, a spine, ribs 12 voxels thick in its wall, and a table
// below.
double trunk(glm::dvec3 x) {
  const auto within = [&](double cx, double cy, double rx, double ry) {
    return std::pow((x.x - cx) / rx, 2) + std::pow((x.y - cy) / ry, 2);
  };
  const double wall = within(256, 250, 220, 160);
  if (wall > 1) return x.y > 440 && x.y < 455 ? 300 : -1000;
  if (within(256, 350, 40, 40) < 1) return 500;
  if (wall > 0.75 && wall < 0.9) return std::sin(x.z / 6 + x.x / 60) > -0.2 ? 450 : 50;
  if (within(160, 230, 75, 100) < 1 || within(352, 230, 75, 100) < 1)
    return std::sin(x.x / 4) * std::sin(x.y / 5) * std::sin(x.z / 7) > 0.6 ? 30 : -850;
  return 50;
}

// Returns the CT with noise of 40 HU, which makes some ten thousand components that are no bone. Voxels are
// 0.7 x 0.7 x 1 mm.
const Volume& ct() {
  static const VolumePtr volume = [] {
    VolumeParts parts;
    parts.geometry.size = {512, 512, 300};
    parts.geometry.patientFromVoxelStep = {{0.7, 0, 0}, {0, 0.7, 0}, {0, 0, 1}};
    std::vector<std::int16_t> values(std::size_t(parts.geometry.voxelCount()));
    parallelFor(300, 0, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t k = begin; k < end; ++k) {
        std::minstd_rand random{unsigned(k + 1)};
        std::normal_distribution<float> noise(0, 40);
        auto* value = values.data() + k * 512 * 512;
        for (int j = 0; j < 512; ++j)
          for (int i = 0; i < 512; ++i) *value++ = std::int16_t(trunk({i, j, k}) + double(noise(random)));
      }
    });
    parts.values = std::move(values);
    std::vector<std::string> warnings;
    return *Volume::make(std::move(parts), warnings);
  }();
  return *volume;
}

const BitMask& bone() {
  static const BitMask mask = voxelsInRange(ct(), {200, infinity});
  return mask;
}
const BitMask& body() {
  static const BitMask mask = voxelsInRange(ct(), {notAirHu, infinity});
  return mask;
}

void threshold(benchmark::State& state) {
  ct();
  for (auto _ : state) benchmark::DoNotOptimize(voxelsInRange(ct(), {200, infinity}));
}

void thresholdAndLargest(benchmark::State& state) {
  std::size_t parts = 0;
  ct();
  for (auto _ : state) {
    const Parts all(voxelsInRange(ct(), {200, infinity}), Neighbours::faces);
    benchmark::DoNotOptimize(all.largest());
    parts = all.count();
  }
  state.counters["parts"] = double(parts);
}

void partsByCorners(benchmark::State& state) {
  bone();
  for (auto _ : state) benchmark::DoNotOptimize(Parts(bone(), Neighbours::corners).largest());
}

void fromAClick(benchmark::State& state) {
  const glm::ivec3 seed(256, 350, 150);
  std::int64_t voxels = 0;
  bone();
  for (auto _ : state) {
    const BitMask found = connected(bone(), {&seed, 1}, Neighbours::faces);
    state.PauseTiming();
    voxels = found.count();
    state.ResumeTiming();
  }
  state.counters["voxels"] = double(voxels);
}

void byBalls(benchmark::State& state, BitMask (*work)(const BitMask&, double, const CancelToken&),
             const BitMask& (*mask)(), double radiusMm) {
  mask();
  for (auto _ : state) benchmark::DoNotOptimize(work(mask(), radiusMm, {}));
}

void filled(benchmark::State& state) {
  body();
  for (auto _ : state) benchmark::DoNotOptimize(holesFilled(body()));
}

void filledInSlices(benchmark::State& state) {
  body();
  for (auto _ : state) benchmark::DoNotOptimize(holesFilledInSlices(body(), int(state.range(0))));
}

void patient(benchmark::State& state) {
  ct();
  for (auto _ : state) benchmark::DoNotOptimize(patientMask(ct()));
}

// Grows strokes in lungs, spine, body and air: everywhere, or in their box of 192^3 voxels.
void fromSeeds(benchmark::State& state) {
  LabelEdit edit{LabelMap(ct().geometry())};
  const std::pair<glm::ivec3, int> strokes[] = {
      {{166, 230, 60}, 1}, {{256, 350, 150}, 2}, {{256, 200, 150}, 3}, {{345, 391, 251}, 4}};
  for (const auto& [at, label] : strokes)
    for (int i = -6; i <= 6; ++i) edit.set(at + glm::ivec3(i, 0, 0), std::uint8_t(label));
  const LabelMap seeds = edit.done();
  const SeedGrowth growth{.marginMm = state.range(0) ? infinity : 0};
  for (auto _ : state) benchmark::DoNotOptimize(grownFromSeeds(ct(), seeds, growth));
}

void labels(benchmark::State& state) {
  const LabelMap none(bone().geometry());
  for (auto _ : state) benchmark::DoNotOptimize(maskOf(withLabel(none, 1, bone()), 1));
}

// Paints a pointer movement of 6 mm with a brush whose diameter in mm is the argument.
void paintedByBall(benchmark::State& state) {
  const LabelMap none(ct().geometry());
  const glm::dvec3 from(180, 180, 150), to(184, 184, 152);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        painted(none, ballStroke(none.geometry(), from, to, double(state.range(0)) / 2), {}));
}

void paintedByObliqueDisc(benchmark::State& state) {
  const LabelMap none(ct().geometry());
  const glm::dvec3 from(180, 180, 150), to(184, 176, 150), normal(1, 1, 1);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        painted(none, discStroke(none.geometry(), from, to, normal, double(state.range(0)) / 2), {}));
}

BENCHMARK(threshold)->Apply(often);
BENCHMARK(thresholdAndLargest)->Apply(often);
BENCHMARK(partsByCorners)->Apply(often);
BENCHMARK(fromAClick)->Apply(often);
#define VOLUMEN_BALLS(work, mask, mm) \
  BENCHMARK_CAPTURE(byBalls, work mask mm mm, work, mask, mm)->Apply(often)
VOLUMEN_BALLS(grown, bone, 3);
VOLUMEN_BALLS(shrunk, bone, 3);
VOLUMEN_BALLS(closed, bone, 3);
VOLUMEN_BALLS(opened, bone, 3);
VOLUMEN_BALLS(grown, body, 3);
VOLUMEN_BALLS(shrunk, body, 3);
VOLUMEN_BALLS(closed, body, 3);
VOLUMEN_BALLS(opened, body, 3);
VOLUMEN_BALLS(closed, bone, 10);
VOLUMEN_BALLS(grown, bone, 30);
BENCHMARK(filled)->Apply(often);
BENCHMARK(filledInSlices)->Arg(0)->Arg(1)->Arg(2)->Apply(often);
BENCHMARK(patient)->Apply(often);
BENCHMARK(labels)->Apply(often);
BENCHMARK(paintedByBall)->Arg(20)->Arg(40)->Apply(often);
BENCHMARK(paintedByObliqueDisc)->Arg(20)->Arg(40)->Apply(often);
BENCHMARK(fromSeeds)->Arg(0)->Arg(1)->Apply(often);

}  // namespace

BENCHMARK_MAIN();
