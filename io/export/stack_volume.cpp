#include "io/export/stack_volume.h"

#include <algorithm>
#include <cmath>

#include "viewer/volume/available_memory.h"

namespace volumen {

namespace {

// Gives values to the pixels outside of the source.
Result<std::optional<float>> fillOutside(std::vector<float>& values,
                                         const std::optional<ValueRange>& padding) {
  float lowest = HUGE_VALF;
  for (const float value : values) lowest = std::fmin(lowest, value);  // fmin() leaves out NaN
  if (lowest == HUGE_VALF) return Error{"No pixel of the slices lies in the volume."};
  const float outside = padding ? float(padding->low) : lowest;
  bool isUsed = false;
  for (float& value : values)
    if (std::isnan(value)) value = outside, isUsed = true;
  return isUsed ? std::optional(outside) : std::nullopt;
}

}  // namespace

Result<StackVolume> volumeOfSlices(const Volume& source, const VoxelGeometry& geometry,
                                   const AppendSlice& append, const Progress& progress) {
  VolumeParts parts{geometry, {}, 1, 0, source.attributes()};
  const auto voxels = std::uint64_t(geometry.voxelCount());
  if (Status s = checkAvailable(source.attributes().name + ": resampling it", voxels * sizeof(float)); !s)
    return s.error();
  std::vector<float> values;
  values.reserve(voxels);
  for (int n = 0; n < geometry.size.z; ++n) {
    if (progress) progress("resampling", std::size_t(n), std::size_t(geometry.size.z));
    if (Status s = append(n, values); !s) return s.error();
  }
  const auto outside = fillOutside(values, source.attributes().padding);
  if (!outside) return outside.error();
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  auto made = Volume::make(std::move(parts), warnings);
  if (!made) return made.error();
  return StackVolume{*std::move(made), *outside};
}

std::vector<int> sourcesBetween(const Loaded& loaded, double low, double high, Interpolation interpolation) {
  constexpr double nearlyWhole = 1e-3;  // voxels
  const double last = loaded.drawn->size().z - 1;
  if (loaded.origins.empty() || !(high >= -0.5 && low <= last + 0.5)) return {};
  const bool isOnSlice = high - low < nearlyWhole && std::abs(low - std::round(low)) < nearlyWhole;
  const int more = interpolation == Interpolation::cubic && !isOnSlice ? 1 : 0;
  const auto first = std::size_t(std::clamp(std::floor(low + nearlyWhole) - more, 0.0, last)),
             end = std::size_t(std::clamp(std::ceil(high - nearlyWhole) + more, 0.0, last));
  std::vector<int> all;
  for (std::size_t k = first; k <= end; ++k)
    for (const int source : {loaded.origins[k].below, loaded.origins[k].above}) all.push_back(source);
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

const char* wordsOf(Interpolation interpolation) {
  return interpolation == Interpolation::linear    ? "linear"
         : interpolation == Interpolation::nearest ? "nearest neighbour"
                                                   : "cubic";
}

}  // namespace volumen
