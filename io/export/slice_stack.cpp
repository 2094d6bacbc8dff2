#include "io/export/slice_stack.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "viewer/slice/cross_planes.h"
#include "viewer/slice/curved_volume.h"
#include "viewer/slice/slice.h"

namespace volumen {

namespace {

struct Range {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
};

const char* wordOf(SlabMode mode) {
  return mode == SlabMode::max ? "max" : mode == SlabMode::min ? "min" : "mean";
}

std::string millimetres(double mm) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g mm", mm);
  return text;
}

Status checkCount(double count, double distanceMm) {
  constexpr double most = 65535;
  if (count <= most) return {};
  return Error{"A slice every " + millimetres(distanceMm) +
               " is more than 65535 slices; take a larger --spacing."};
}

std::string planeName(const SliceStack& stack) {
  if (!stack.across.empty()) return "Across " + (stack.curve.empty() ? "a curve" : stack.curve);
  const SlicePlane& plane = stack.first;
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

// PS3.3 C.8.16.1.4 has these terms for values made of several.
Resampling resamplingOf(const SliceStack& stack) {
  const SlicePlane& plane = stack.first;
  Resampling how;
  how.words = wordsOf(stack) + ", resampled with " + wordsOf(plane.interpolation) + " interpolation";
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

std::vector<int> sourcesOf(const SlicePlane& plane, const Loaded& loaded) {
  const VoxelGeometry& geometry = loaded.drawn->geometry();
  const double inPixel = 0.5 / double(subSamples(plane, geometry));
  const double deep = 0.5 * plane.slabMm * (1 - 1 / double(slabSamples(plane, geometry)));
  Range k;
  for (const double x : {inPixel, plane.size.x - inPixel})
    for (const double y : {inPixel, plane.size.y - inPixel})
      for (const double depth : {-deep, deep})
        k.add(geometry.voxelFromPatient(plane.patientFromPixel({x, y}) + depth * plane.normal()).z);
  return sourcesBetween(loaded, k.low, k.high, plane.interpolation);
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

SlicePlane SliceStack::plane(int n) const {
  if (!across.empty()) return across[std::size_t(n)];
  SlicePlane plane = first;
  plane.centre += n * distanceMm * first.normal();
  return plane;
}

Result<SliceStack> stackThrough(const VoxelGeometry& geometry, SlicePlane plane, double distanceMm) {
  const glm::dvec3 normal = plane.normal();
  Range along;
  for (const glm::dvec3& corner : geometry.boxCorners()) along.add(glm::dot(corner - plane.centre, normal));
  const double count = std::max(std::ceil((along.high - along.low) / distanceMm - 1e-6), 1.0);
  if (Status s = checkCount(count, distanceMm); !s) return s.error();
  const double middle = 0.5 * (along.low + along.high);
  plane.centre += (middle - 0.5 * (count - 1) * distanceMm) * normal;
  return SliceStack{plane, int(count), distanceMm};
}

Result<SliceStack> stackAlong(const SmoothCurve& curve, const std::string& name, const SlicePlane& like,
                              double distanceMm) {
  if (curve.length() > CurvedGrid::longest) return Error{"The curve is longer than 10 m."};
  if (Status s = checkCount(curve.length() / distanceMm + 1, distanceMm); !s) return s.error();
  std::vector<SlicePlane> planes = planesAcross(curve, like, distanceMm);
  return SliceStack{planes.front(), int(planes.size()), distanceMm, planes, name};
}

Result<StackVolume> resampleStack(const Volume& volume, const SliceStack& stack, const Progress& progress,
                                  const CancelToken& cancel) {
  if (!volume.geometry().calibrated)
    return Error{
        volume.attributes().name +
        " is not calibrated: slices along a plane need positions in mm; `volumen slice` writes pictures."};
  if (Status s = checkPlane(stack.first); !s) return s.error();
  const auto append = [&](int n, std::vector<float>& values) {
    const auto use = [&](std::span<const float> rows) -> Status {
      values.insert(values.end(), rows.begin(), rows.end());
      return {};
    };
    return resampleSliceByRows(volume, stack.plane(n), use, cancel);
  };
  return volumeOfSlices(volume, geometryOf(stack), append, progress);
}

std::string wordsOf(const SliceStack& stack) {
  const SlicePlane& plane = stack.first;
  const std::string name = planeName(stack), every = "every " + millimetres(stack.distanceMm);
  const bool isOne = stack.count == 1;
  if (plane.slabMm == 0) return name + (isOne ? ", one slice" : ", " + every);
  const std::string slabs = name + (isOne ? ", slab of " : ", slabs of ") + millimetres(plane.slabMm) + " (" +
                            wordOf(plane.slabMode) + ")";
  return isOne || stack.distanceMm == plane.slabMm ? slabs : slabs + ", " + every;
}

DicomSeriesTags stackTags(DicomSeriesTags ofSource, const Loaded& loaded, const SliceStack& stack,
                          int seriesNumber) {
  ofSource.description = inOneLine(wordsOf(stack));
  ofSource.seriesNumber = std::to_string(seriesNumber);
  ofSource.origins.clear();
  Resampling how = resamplingOf(stack);
  for (int n = 0; n < stack.count; ++n) {
    how.sources.push_back(sourcesOf(stack.plane(n), loaded));
    if (!stack.across.empty()) how.places.push_back(geometryOf({stack.plane(n), 1, stack.distanceMm}));
  }
  ofSource.resampling = std::move(how);
  return ofSource;
}

}  // namespace volumen
