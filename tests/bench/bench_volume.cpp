// Times the passes over a volume, in voxels a second: Sobel gradients, range of values, block ranges, slopes
// and percentiles.
#include <benchmark/benchmark.h>

#include <random>

#include "viewer/volume/block_ranges.h"
#include "viewer/volume/gradient_bounds.h"
#include "viewer/volume/gradients.h"
#include "viewer/volume/histogram.h"

namespace {

using namespace volumen;

// Returns a cube of 16-bit noise in the range of a CT.
VolumePtr noise(int edge) {
  std::minstd_rand random(1);
  VolumeParts parts;
  parts.geometry.size = glm::ivec3(edge);
  std::vector<std::int16_t> values(parts.geometry.voxelCount());
  for (auto& v : values) v = std::int16_t(int(random() % 4096) - 1024);
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

template <class Pass>
void run(benchmark::State& state, Pass pass) {
  const VolumePtr volume = noise(int(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(pass(*volume));
  state.SetItemsProcessed(state.iterations() * volume->geometry().voxelCount());
}

void sobel16Bits(benchmark::State& state) { run(state, sobel16); }
void sobel32Bits(benchmark::State& state) { run(state, sobel32); }
void blocks(benchmark::State& state) { run(state, blockRanges); }
void rangeOfValues(benchmark::State& state) { run(state, valueRange); }
void slopes(benchmark::State& state) {
  const VolumePtr volume = noise(int(state.range(0)));
  const BlockRanges blockRanges = blockRanges(*volume);
  const ValueRange range = valueRange(*volume);
  run(state, [&](const Volume& v) { return gradientBoundsOf(v, blockRanges, range); });
}
void percentilesOfAll(benchmark::State& state) {
  run(state, [](const Volume& v) { return percentiles(v, {1, 999}); });
}

BENCHMARK(sobel16Bits)->Arg(256)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(sobel32Bits)->Arg(256)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(blocks)->Arg(256)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(rangeOfValues)->Arg(256)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(slopes)->Arg(256)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(percentilesOfAll)->Arg(256)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
