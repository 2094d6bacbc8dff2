#include "io/export/slice_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "viewer/slice/slice.h"
#include "viewer/volume/available_memory.h"

namespace volumen {

namespace {

constexpr double nearlyWhole = 1e-3;  // voxels

struct Range {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
};

const char* wordOf(SlabMode mode) {
  return mode == SlabMode::max ? "max" : mode == SlabMode::min ? "min" : "mean";
}

const char* wordOf(Interpolation interpolation) {
  return interpolation == Interpolation::linear    ? "linear"
         : interpolation == Interpolation::nearest ? "nearest neighbour"
                                                   : "cubic";
}

std::string millimetres(double mm) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g mm", mm);
  return text;
}

const char* planeName(const SlicePlane& plane) {
  constexpr double within = 1e-6;
  const std::pair<NamedPlane, const char*> names[] = {
      {NamedPlane::axial, "Axial"}, {NamedPlane::coronal, "Coronal"}, {NamedPlane::sagittal, "Sagittal"}};
  for (const auto& [named, name] : names) {
    const SlicePlane like = namedPlane(VoxelGeometry(), named);
    if (glm::distance(like.right, plane.right) < within && glm::distance(like.down, plane.down) < within)
      return name;
  }
  return "Oblique";
}

// Returns the first and last slice of a volume whose voxels the samples of a plane lie on or between.
std::pair<int, int> slicesMet(const VoxelGeometry& geometry, const SlicePlane& plane) {
  const double inPixel = 0.5 / double(subSamples(plane, geometry));
  const double deep = 0.5 * plane.slabMm * (1 - 1 / double(slabSamples(plane, geometry)));
  Range k;
  for (const double x : {inPixel, plane.size.x - inPixel})
    for (const double y : {inPixel, plane.size.y - inPixel})
      for (const double depth : {-deep, deep})
        k.add(geometry.voxelFromPatient(plane.patientFromPixel({x, y}) + depth * plane.normal()).z);
  const bool isOnSlice = k.high - k.low < nearlyWhole && std::abs(k.low - std::round(k.low)) < nearlyWhole;
  const int more = plane.interpolation == Interpolation::cubic && !isOnSlice ? 1 : 0;
  const double last = geometry.size.z - 1;
  return {int(std::clamp(std::floor(k.low + nearlyWhole) - more, 0.0, last)),
          int(std::clamp(std::ceil(k.high - nearlyWhole) + more, 0.0, last))};
}

std::vector<int> sourcesOf(const SlicePlane& plane, const Loaded& loaded) {
  std::vector<int> all;
  if (loaded.origins.empty()) return all;
  const auto [first, last] = slicesMet(loaded.drawn->geometry(), plane);
  for (int k = first; k <= last; ++k) {
    const SliceOrigin& origin = loaded.origins[std::size_t(k)];
    all.push_back(origin.below);
    all.push_back(origin.above);
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

VoxelGeometry geometryOf(const SliceStack& stack) {
  const SlicePlane& first = stack.first;
  VoxelGeometry geometry;
  geometry.size = {first.size, stack.count};
  geometry.patientFromVoxelStep = {first.right * first.mmPerPixel, first.down * first.mmPerPixel,
                                   first.normal() * stack.distanceMm};
  geometry.origin = first.patientFromPixel({0.5, 0.5});
  return geometry;
}

// Gives values to the pixels outside of the source.
Result<std::optional<float>> fillOutside(std::vector<float>& values,
                                         const std::optional<ValueRange>& padding) {
  Range inside;
  for (const float value : values)
    if (!std::isnan(value)) inside.add(value);
  if (inside.low > inside.high) return Error{"No pixel of the slices lies in the volume."};
  const float outside = float(padding ? padding->low : inside.low);
  bool isUsed = false;
  for (float& value : values)
    if (std::isnan(value)) value = outside, isUsed = true;
  return isUsed ? std::optional(outside) : std::nullopt;
}

// PS3.3 C.8.16.1.4 has these terms for values made of several.
Resampling resamplingOf(const SliceStack& stack) {
  const SlicePlane& plane = stack.first;
  Resampling how;
  how.words = wordsOf(stack) + ", resampled with " + wordOf(plane.interpolation) + " interpolation";
  if (plane.average) how.words += ", averaged over pixels";
  how.thicknessMm = plane.slabMm > 0 ? plane.slabMm : stack.distanceMm;
  how.code = {"113072", "DCM", "Multiplanar reformatting"};
  how.imageType = "RESAMPLED";
  if (plane.slabMm == 0) return how;
  if (plane.slabMode == SlabMode::max) how.code = {"113078", "DCM", "Maximum intensity projection"};
  if (plane.slabMode == SlabMode::min) how.code = {"113079", "DCM", "Minimum intensity projection"};
  how.imageType = plane.slabMode == SlabMode::max   ? "MAXIMUM"
                  : plane.slabMode == SlabMode::min ? "MINIMUM"
                                                    : "MEAN";
  return how;
}

}  // namespace

SlicePlane SliceStack::plane(int n) const {
  SlicePlane plane = first;
  plane.centre += n * distanceMm * first.normal();
  return plane;
}

Result<SliceStack> stackThrough(const VoxelGeometry& geometry, SlicePlane plane, double distanceMm) {
  constexpr double most = 65535;
  const glm::dvec3 normal = plane.normal();
  Range along;
  for (const glm::dvec3& corner : geometry.boxCorners()) along.add(glm::dot(corner - plane.centre, normal));
  const double count = std::max(std::ceil((along.high - along.low) / distanceMm - 1e-6), 1.0);
  if (count > most)
    return Error{"A slice every " + millimetres(distanceMm) +
                 " is more than 65535 slices; take a larger --spacing."};
  const double middle = 0.5 * (along.low + along.high);
  plane.centre += (middle - 0.5 * (count - 1) * distanceMm) * normal;
  return SliceStack{plane, int(count), distanceMm};
}

Result<StackVolume> resampleStack(const Volume& volume, const SliceStack& stack, const Progress& progress,
                                  const CancelToken& cancel) {
  const std::string& name = volume.attributes().name;
  if (!volume.geometry().calibrated)
    return Error{
        name +
        " is not calibrated: slices along a plane need positions in mm; `volumen slice` writes pictures."};
  if (Status s = checkPlane(stack.first); !s) return s.error();
  VolumeParts parts{geometryOf(stack), {}, 1, 0, volume.attributes()};
  const auto voxels = std::uint64_t(parts.geometry.voxelCount());
  if (Status s = checkAvailable(name + ": resampling it", voxels * sizeof(float)); !s) return s.error();
  std::vector<float> values;
  values.reserve(voxels);
  for (int n = 0; n < stack.count; ++n) {
    if (progress) progress("resampling", std::size_t(n), std::size_t(stack.count));
    const auto use = [&](std::span<const float> rows) -> Status {
      values.insert(values.end(), rows.begin(), rows.end());
      return {};
    };
    if (Status s = resampleSliceByRows(volume, stack.plane(n), use, cancel); !s) return s.error();
  }
  const auto outside = fillOutside(values, volume.attributes().padding);
  if (!outside) return outside.error();
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  auto made = Volume::make(std::move(parts), warnings);
  if (!made) return made.error();
  return StackVolume{*std::move(made), *outside};
}

std::string wordsOf(const SliceStack& stack) {
  const SlicePlane& plane = stack.first;
  const std::string name = planeName(plane), every = "every " + millimetres(stack.distanceMm);
  const bool isOne = stack.count == 1;
  if (plane.slabMm == 0) return name + (isOne ? ", one slice" : ", " + every);
  const std::string slabs = name + (isOne ? ", slab of " : ", slabs of ") + millimetres(plane.slabMm) + " (" +
                            wordOf(plane.slabMode) + ")";
  return isOne || stack.distanceMm == plane.slabMm ? slabs : slabs + ", " + every;
}

DicomSeriesTags stackTags(DicomSeriesTags ofSource, const Loaded& loaded, const SliceStack& stack,
                          int seriesNumber) {
  ofSource.description = wordsOf(stack);
  ofSource.seriesNumber = std::to_string(seriesNumber);
  ofSource.origins.clear();
  Resampling how = resamplingOf(stack);
  for (int n = 0; n < stack.count; ++n) how.sources.push_back(sourcesOf(stack.plane(n), loaded));
  ofSource.resampling = std::move(how);
  return ofSource;
}

}  // namespace volumen
