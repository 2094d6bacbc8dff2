#include "viewer/measure/profile.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "viewer/measure/region.h"
#include "viewer/slice/sample_line.h"

namespace volumen {

namespace {

constexpr double samplesAVoxel = 4;
constexpr double mostSamples = 4000;

// Returns the values at both ends of a segment and at the steps between.
std::vector<float> valuesAlong(glm::dvec3 from, glm::dvec3 to, std::int64_t steps, const Volume& volume,
                               LineKernel kernel) {
  const glm::dvec3 start = volume.geometry().voxelFromPatient(from);
  const SampleLine line{start, (volume.geometry().voxelFromPatient(to) - start) / double(steps)};
  const SampleRange inside = insideBox(line, {0, steps + 1}, volume.size());
  std::vector<float> values(std::size_t(steps + 1), std::numeric_limits<float>::quiet_NaN());
  if (inside.first >= inside.last) return values;
  std::vector<float> stored(std::size_t(inside.last - inside.first + lineSlack));
  const void* samples =
      std::visit([](const auto& v) { return static_cast<const void*>(v.data()); }, volume.stored());
  kernel(samples, volume.size(), line, inside, stored.data());
  for (std::int64_t n = inside.first; n < inside.last; ++n)
    values[std::size_t(n)] = volume.realValue(double(stored[std::size_t(n - inside.first)]));
  return values;
}

}  // namespace

std::vector<ProfilePoint> profileAlong(std::span<const glm::dvec3> line, const Volume& volume,
                                       Interpolation interpolation) {
  double length = 0;
  for (std::size_t n = 1; n < line.size(); ++n) length += glm::length(line[n] - line[n - 1]);
  std::vector<ProfilePoint> profile;
  if (!(length > 0)) return profile;
  const LineKernel kernel = chooseLineKernel(volume.stored(), interpolation);
  double before = 0;
  for (std::size_t n = 1; n < line.size(); ++n) {
    const glm::dvec3 way = line[n] - line[n - 1];
    const double mm = glm::length(way);
    if (mm == 0) continue;
    const double wanted = samplesAVoxel * mm / voxelAlong(volume.geometry(), way / mm);
    const auto steps = std::int64_t(std::ceil(std::clamp(wanted, 1.0, mostSamples * mm / length + 1)));
    const std::vector<float> values = valuesAlong(line[n - 1], line[n], steps, volume, kernel);
    for (std::int64_t k = profile.empty() ? 0 : 1; k <= steps; ++k)
      profile.push_back({(before + mm * double(k) / double(steps)) / length, double(values[std::size_t(k)])});
    before += mm;
  }
  return profile;
}

ValueCounts countsOf(const Shape& region, const Volume& volume) {
  std::vector<double> values;
  bool areWhole = true;
  forEachVoxelOf(region, volume, [&](glm::ivec3, double value) {
    values.push_back(value);
    areWhole = areWhole && value == std::round(value);
  });
  if (values.empty()) return {};
  const auto [least, most] = std::ranges::minmax(values);
  ValueCounts counts = binsFor({least, most}, areWhole);
  for (const double value : values) counts.add(value);
  return counts;
}

}  // namespace volumen
