// Times a plane through 512 x 512 x 300 voxels of a CT and its conversion to grey. Prints medians of real
// time, on all cores and on one.
#include <benchmark/benchmark.h>

#include <glm/geometric.hpp>
#include <random>

#include "viewer/slice/grey.h"
#include "viewer/slice/slice.h"

namespace {

using namespace volumen;

// Returns 16-bit noise in the range of a CT with voxels of 0.7 x 0.7 x 1 mm.
const Volume& noise() {
  static const VolumePtr volume = [] {
    std::minstd_rand random(1);
    VolumeParts parts;
    parts.geometry.size = {512, 512, 300};
    parts.geometry.patientFromVoxelStep = {{0.7, 0, 0}, {0, 0.7, 0}, {0, 0, 1}};
    std::vector<std::int16_t> values(parts.geometry.voxelCount());
    for (auto& v : values) v = std::int16_t(int(random() % 4096) - 1024);
    parts.values = std::move(values);
    std::vector<std::string> warnings;
    return *Volume::make(std::move(parts), warnings);
  }();
  return *volume;
}

SlicePlane named(NamedPlane name) {
  SlicePlane plane = namedPlane(noise().geometry(), name);
  plane.size = glm::ivec2(512);
  return plane;
}

SlicePlane oblique() {
  const glm::dvec3 right = glm::normalize(glm::dvec3(1, 0.6, 0.2));
  SlicePlane plane =
      planeAlong(noise().geometry(), right, glm::normalize(glm::cross(glm::dvec3(0.3, -0.4, 1), right)));
  plane.size = glm::ivec2(512);
  return plane;
}

void resample(benchmark::State& state, const SlicePlane& plane) {
  for (auto _ : state) benchmark::DoNotOptimize(resampleSlice(noise(), plane, int(state.range(0))));
}

SlicePlane with(SlicePlane plane, Interpolation interpolation, double slabMm = 0,
                SlabMode mode = SlabMode::max) {
  plane.interpolation = interpolation;
  plane.slabMm = slabMm;
  plane.slabMode = mode;
  return plane;
}

SlicePlane averaged() {
  SlicePlane plane = named(NamedPlane::axial);
  plane.mmPerPixel *= 2;
  plane.size /= 2;
  plane.average = true;
  return plane;
}

GreyMapping grey(WindowFunction function) {
  GreyMapping mapping;
  mapping.window = {40, 400};
  mapping.function = function;
  return mapping;
}

void toGrey(benchmark::State& state, const GreyMapping& mapping) {
  SlicePlane plane = oblique();
  plane.size = glm::ivec2(1000);
  plane.mmPerPixel /= 2;
  const auto slice = resampleSlice(noise(), plane);
  for (auto _ : state) benchmark::DoNotOptimize(greyBytes(slice->values, mapping));
}

#define VOLUMEN_BENCH(what, plane)         \
  BENCHMARK_CAPTURE(resample, what, plane) \
      ->Arg(0)                             \
      ->Arg(1)                             \
      ->UseRealTime()                      \
      ->Unit(benchmark::kMillisecond)      \
      ->Repetitions(9)                     \
      ->ReportAggregatesOnly()

VOLUMEN_BENCH(linear axial, named(NamedPlane::axial));
VOLUMEN_BENCH(linear coronal, named(NamedPlane::coronal));
VOLUMEN_BENCH(linear sagittal, named(NamedPlane::sagittal));
VOLUMEN_BENCH(linear oblique, oblique());
VOLUMEN_BENCH(nearest oblique, with(oblique(), Interpolation::nearest));
VOLUMEN_BENCH(cubic axial, with(named(NamedPlane::axial), Interpolation::cubic));
VOLUMEN_BENCH(cubic sagittal, with(named(NamedPlane::sagittal), Interpolation::cubic));
VOLUMEN_BENCH(cubic oblique, with(oblique(), Interpolation::cubic));
VOLUMEN_BENCH(max 20 mm axial, with(named(NamedPlane::axial), Interpolation::linear, 20));
VOLUMEN_BENCH(max 20 mm sagittal, with(named(NamedPlane::sagittal), Interpolation::linear, 20));
VOLUMEN_BENCH(max 20 mm oblique, with(oblique(), Interpolation::linear, 20));
VOLUMEN_BENCH(mean 20 mm oblique, with(oblique(), Interpolation::linear, 20, SlabMode::mean));
VOLUMEN_BENCH(averaged 2 x 2, averaged());
BENCHMARK_CAPTURE(toGrey, LINEAR, grey(WindowFunction::linear))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(toGrey, SIGMOID, grey(WindowFunction::sigmoid))
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
