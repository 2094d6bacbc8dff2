// Hard volumes: every stored type and rescale, sizes down to one voxel, every kind of grid.
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/hard/hard_cases.h"
#include "viewer/volume/histogram.h"

namespace volumen::tests {
namespace {

using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

/// Returns a volume of type T with stored values low .. high (waves over most of that range) and the given
/// rescale.
template <class T>
VolumePtr stored(double low, double high, double slope, double intercept, ivec3 size = {17, 15, 14}) {
  VolumeParts parts;
  parts.geometry.size = size;
  parts.geometry.origin = -parts.geometry.centre();
  parts.slope = slope;
  parts.intercept = intercept;
  std::vector<T> values;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) values.push_back(T(low + (high - low) * waves(dvec3(i, j, k))));
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

/// Returns waves with values that a file may hold among ordinary ones: NaN, infinities and 1e30. One infinity
/// is at (7, infinityAtJ, 11).
VolumePtr spoiltFloats(int infinityAtJ) {
  VolumeParts parts;
  parts.geometry.size = ivec3(21, 20, 22);
  std::vector<float> values;
  for (int k = 0; k < 22; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 21; ++i) values.push_back(float(1000 * waves(dvec3(i, j, k))));
  const float infinity = std::numeric_limits<float>::infinity();
  // These are too few to change the percentiles of picture.md 5.
  values[4321] = values[4322] = std::numeric_limits<float>::quiet_NaN();
  values[std::size_t(11 * 20 + infinityAtJ) * 21 + 7] = infinity;
  values[2777] = -infinity;
  values[6100] = 1e30f;
  values[7001] = -1e30f;
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

VolumePtr floats(ivec3 size, dmat3 L = dmat3(1)) {
  return volumeOf(size, L, [](dvec3 x) { return 1000 * waves(x); });
}

VolumePtr farAway() {
  const VolumePtr near = wavesVolume();
  VolumeParts parts;
  parts.geometry = near->geometry();
  parts.geometry.origin += dvec3(1e5, -1e5, 1e5);
  parts.values = near->stored();
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

constexpr const char* spoilt = "floats with NaN, infinities and 1e30";

struct Named {
  const char* name;
  VolumePtr volume;
  ValueRange range;  ///< over which curves are laid
  bool delicate = false;
};

std::vector<Named> volumes() {
  const double tilt = std::tan(glm::radians(30.0));
  const ValueRange waves{0, 1000};
  const auto diagonal = [](double i, double j, double k) { return dmat3({i, 0, 0}, {0, j, 0}, {0, 0, k}); };
  return {
      {"signed 16-bit full range", stored<std::int16_t>(-32768, 32767, 1, 0), {-32768, 32767}, true},
      {"unsigned 16-bit full range", stored<std::uint16_t>(0, 65535, 1, 0), {0, 65535}, true},
      {"12 bits in 16", stored<std::uint16_t>(0, 4095, 1, -1024), {-1024, 3071}},
      {"8 bits", stored<std::uint8_t>(0, 255, 1, 0), {0, 255}},
      {"slope 0.01", stored<std::uint16_t>(0, 65535, 0.01, -200), {-200, 455.35}},
      {"slope 2.022", stored<std::int16_t>(-1000, 2000, 2.022, -512.7), {-2534.7, 3531.3}},
      {"negative slope", stored<std::int16_t>(-1000, 2000, -0.5, 700), {-300, 1200}, true},
      {spoilt, spoiltFloats(8), waves, true},
      {"floats of 1e-20",
       volumeOf({12, 13, 11}, dmat3(1), [](dvec3 x) { return 1e-20 * tests::waves(x); }),
       {0, 1e-20}},
      {"one voxel", floats(ivec3(1)), waves, true},
      {"one voxel of 16 bits", stored<std::int16_t>(0, 1000, 1, 0, ivec3(1)), waves, true},
      {"one slice of 16 bits", stored<std::uint16_t>(0, 1000, 1, 0, {17, 16, 1}), waves, true},
      {"one column of 16 bits, 1 x 1 x 41", stored<std::int16_t>(0, 1000, 1, 0, {1, 1, 41}), waves, true},
      {"one row of 8 bits, 45 x 1 x 1", stored<std::uint8_t>(0, 250, 4, 0, {45, 1, 1}), waves, true},
      {"one slice", floats({18, 16, 1}), waves, true},
      {"two slices", floats({18, 16, 2}), waves, true},
      {"one column, 1 x 1 x 40", floats({1, 1, 40}), waves, true},
      {"2049 wide", floats({2049, 3, 3}), waves, true},
      {"spacing 0.3 x 0.3 x 5", floats({20, 20, 6}, diagonal(0.3, 0.3, 5)), waves},
      {"spacing 1e-4 mm", floats(ivec3(14), dmat3(1e-4)), waves},
      {"spacing 1e4 mm", floats(ivec3(14), dmat3(1e4)), waves},
      {"sheared by a tilt of 30 degrees", floats({16, 15, 10}, dmat3({1, 0, 0}, {0, 1, 0}, {0, 2 * tilt, 2})),
       waves},
      {"left-handed grid", floats({16, 15, 10}, diagonal(-1, 1.2, 1.5)), waves},
      {"1e5 mm away from the origin", farAway(), waves, true},
  };
}

VolumePtr between(double low, double high) {
  return volumeOf({12, 13, 11}, dmat3(1), [=](dvec3 x) { return low + (high - low) * tests::waves(x); });
}

/// Adds float ranges that are hard to calculate with: tiny values, tiny differences, and near the largest
/// float.
void addRanges(HardCases& cases) {
  const std::pair<const char*, ValueRange> ranges[] = {{"floats of 1e-36", {0, 1e-36}},
                                                       {"denormal floats, 1e-42", {0, 1e-42}},
                                                       {"floats of 1e25", {-2e24, 1e25}},
                                                       {"floats of 100000 to 100001", {100000, 100001}},
                                                       {"floats of -2000 to -1999.9", {-2000, -1999.9}}};
  for (const auto& [name, range] : ranges) {
    const VolumePtr volume = between(range.low, range.high);
    const ValueRange values = valueRange(*volume);
    const std::vector<CurvePoint> fromTheLeast = {{float(values.low), {1, 0.8, 0.6}, 0.01},
                                                  {float(values.high), {0.5, 1, 1}, 0.6}};
    cases.addBoth({.name = name + std::string(", curve from the least value on"),
                   .volume = volume,
                   .scene = sceneOf(*volume, fromTheLeast),
                   .delicate = true});
    cases.add({.name = name + std::string(", curve with steps"),
               .volume = volume,
               .scene = sceneOf(*volume, steppedCurve(range.low, range.high), {0.6, -0.3, 0.7})});
    HardCase& mean = cases.add(
        {.name = name + std::string(", average"), .volume = volume, .scene = sceneOf(*volume, fromTheLeast)});
    mean.scene.mode = Mode::average;
    mean.scene.window = Window{(range.low + range.high) / 2, range.high - range.low};
  }
}

constexpr const char* decidedByNothing =
    "a ray that passes 1e30 for a hair's breadth has its extreme and its mean there: no sampling sees that";

/// Adds 1e30 beside the border, where a sample lies exactly on the last voxel. a + f (b - a) with f = 1 and a
/// = 1e30 loses b in float32.
void addSpoiltBorder(HardCases& cases) {
  const VolumePtr volume = spoiltFloats(18);
  cases.addBoth({.name = "1e30 beside the border",
                 .volume = volume,
                 .scene = sceneOf(*volume, softCurve(0, 1000)),
                 .finiteOnly = "float32 loses an ordinary value beside 1e30",
                 .delicate = true});
}

/// Adds rays along and across the longest axis, close enough to see it.
void addLongVolumes(HardCases& cases, const Named& v) {
  const bool alongX = v.volume->size().x > v.volume->size().z;
  const int length = std::max(v.volume->size().x, v.volume->size().z);
  HardCase along{
      .name = v.name + std::string(", seen along it"),
      .volume = v.volume,
      .scene = sceneOf(*v.volume, softCurve(0, 1000), alongX ? dvec3(1, 4e-4, 3e-4) : dvec3(0.01, 0.012, 1)),
      .delicate = true};
  along.scene.transferFunction.unitDistance = length / 20.0;
  along.scene.camera->height = 3;
  along.size = {5, 5};
  cases.add(along);
  HardCase across{.name = v.name + std::string(", seen across it"),
                  .volume = v.volume,
                  .scene = sceneOf(*v.volume, softCurve(0, 1000), {0.02, 1, 0.03}),
                  .size = {std::min(length, 400), 2}};
  across.scene.camera->up = alongX ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
  across.scene.camera->height = 2.0 * length / across.size.x;
  cases.add(across);
}

}  // namespace

void addVolumeCases(HardCases& cases) {
  addSpoiltBorder(cases);
  addRanges(cases);
  for (const Named& v : volumes()) {
    const auto [low, high] = v.range;
    if (std::max(v.volume->size().x, v.volume->size().z) >= 40) addLongVolumes(cases, v);
    cases.addBoth({.name = v.name + std::string(", soft curve"),
                   .volume = v.volume,
                   .scene = sceneOf(*v.volume, softCurve(low, high)),
                   .delicate = v.delicate});
    cases.addBoth({.name = v.name + std::string(", curve with steps"),
                   .volume = v.volume,
                   .scene = sceneOf(*v.volume, steppedCurve(low, high), {0.6, -0.3, 0.7})});
    for (const auto& [name, mode] :
         {std::pair{", mip", Mode::mip}, {", minip", Mode::minip}, {", average", Mode::average}}) {
      HardCase& c = cases.add({.name = v.name + std::string(name),
                               .volume = v.volume,
                               .scene = sceneOf(*v.volume, {{0, {1, 1, 1}, 0}}),
                               .delicate = v.delicate});
      c.scene.mode = mode;
      if (v.name == std::string(spoilt) && mode != Mode::mip) c.finiteOnly = decidedByNothing;
      c.scene.window = Window{(low + high) / 2, high - low};
    }
  }
}

}  // namespace volumen::tests
