#include "viewer/phantoms/phantoms.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <string_view>

#include "viewer/phantoms/phantom_head.h"
#include "viewer/volume/buffer.h"

namespace volumen {
namespace {

constexpr int smallestSize = 2, largestSize = 1024;

// Returns voxels of 1 mm whose centres are symmetric about the origin of patient space.
VoxelGeometry cubeOf(int edge) { return {.size = glm::ivec3(edge), .origin = glm::dvec3(-0.5 * (edge - 1))}; }

// Samples valueAt(x) at every voxel of a cube, with x in mm from its centre.
template <class T, class ValueAt>
VolumeParts sampled(int edge, ValueAt valueAt) {
  VolumeParts parts;
  parts.geometry = cubeOf(edge);
  auto values = zeros<T>(std::size_t(parts.geometry.voxelCount()));
  tbb::parallel_for(0, edge, [&](int k) {
    T* out = values.data() + std::size_t(k) * edge * edge;
    for (int j = 0; j < edge; ++j)
      for (int i = 0; i < edge; ++i) *out++ = T(valueAt(parts.geometry.patientFromVoxel({i, j, k})));
  });
  parts.values = std::move(values);
  return parts;
}

// Returns 1 everywhere (paper 4: the solid cube).
VolumeParts solid(int edge) {
  return sampled<std::uint8_t>(edge, [](glm::dvec3) { return 1; });
}

// Returns 1 where |x| <= N/2, else 0 (paper 4: the sphere and the opaque sphere; their scenes differ).
VolumeParts sphere(int edge) {
  return sampled<std::uint8_t>(edge, [=](glm::dvec3 x) { return glm::length(x) <= 0.5 * edge; });
}

// Returns 1000 erfc((r - R)/(0.6 sqrt 2))/2: a ball of radius R = 20 N/64, blurred by a Gaussian of 0.6
// voxels. The distance r counts from a centre off every symmetry of the grid, in voxels (31.8, 31.3, 31.6)
// for N = 64.
VolumeParts softSphere(int edge) {
  const glm::dvec3 centre(0.3, -0.2, 0.1);
  const double radius = 20.0 * edge / 64;
  return sampled<float>(edge, [=](glm::dvec3 x) {
    return 500 * std::erfc((glm::length(x - centre) - radius) / (0.6 * glm::root_two<double>()));
  });
}

// Returns the voxel's index i.
VolumeParts ramp(int edge) {
  return sampled<std::int16_t>(edge, [=](glm::dvec3 x) { return std::lround(x.x + 0.5 * (edge - 1)); });
}

// Returns 1 where the voxel's centre lies in the middle half of the edge along every axis, else 0. The middle
// half is N/4 .. 3N/4, counted in cells from the first cell's outer face.
VolumeParts cube(int edge) {
  return sampled<std::uint8_t>(edge, [=](glm::dvec3 x) {
    const glm::dvec3 distance = glm::abs(x);
    return std::max({distance.x, distance.y, distance.z}) <= 0.25 * edge;
  });
}

// Returns the signal of Marschner and Lobb 1994 on [-1, 1]^3 with fM = 6, alpha = 0.25:
// (1 - sin(pi z / 2) + alpha (1 + cos(2 pi fM cos(pi r / 2)))) / (2 (1 + alpha)), r = sqrt(x^2 + y^2).
VolumeParts marschnerLobb(int edge) {
  constexpr double fM = 6, alpha = 0.25, pi = glm::pi<double>();
  return sampled<float>(edge, [=](glm::dvec3 xMm) {
    const glm::dvec3 x = xMm / (0.5 * (edge - 1));
    const double rings = std::cos(2 * pi * fM * std::cos(pi / 2 * std::hypot(x.x, x.y)));
    return (1 - std::sin(pi / 2 * x.z) + alpha * (1 + rings)) / (2 * (1 + alpha));
  });
}

struct Entry {
  const char* name;
  int defaultSize;
  VolumeParts (*make)(int size);
  VoxelGeometry (*geometry)(int size);
  const char *valueType, *modality;
};

constexpr Entry phantoms[] = {
    {"ct-head", 512, [](int size) { return headPhantom(size); }, headGeometry, "int16", "CT"},
    {"sphere", 64, sphere, cubeOf, "uint8", ""},
    {"opaque-sphere", 64, sphere, cubeOf, "uint8", ""},
    {"solid", 64, solid, cubeOf, "uint8", ""},
    {"soft-sphere", 64, softSphere, cubeOf, "float32", ""},
    {"ramp", 64, ramp, cubeOf, "int16", ""},
    {"cube", 64, cube, cubeOf, "uint8", ""},
    {"marschner-lobb", 41, marschnerLobb, cubeOf, "float32", ""},
};

std::optional<int> sizeFrom(std::string_view text) {
  int size = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (size < smallestSize || size > largestSize) return std::nullopt;
  return size;
}

struct Chosen {
  const Entry* phantom;
  int size;
};

Result<Chosen> choose(const std::string& text) {
  const auto colon = text.find(':');
  const std::string name = text.substr(0, colon);
  for (const Entry& entry : phantoms) {
    if (entry.name != name) continue;
    std::optional<int> size = entry.defaultSize;
    if (colon != std::string::npos) size = sizeFrom(std::string_view(text).substr(colon + 1));
    if (size) return Chosen{&entry, *size};
    return Error{"The size of phantom \"" + text + "\" is not a whole number from " +
                 std::to_string(smallestSize) + " to " + std::to_string(largestSize) + "; write " + name +
                 " or, for example, " + name + ":64."};
  }
  std::string list;
  for (const Entry& entry : phantoms) list += (list.empty() ? "" : ", ") + std::string(entry.name);
  return Error{"Unknown phantom \"" + name + "\". Phantoms: " + list + "."};
}

Result<VolumePtr> volumeOf(VolumeParts parts, const std::string& name) {
  parts.attributes.name = name;
  std::vector<std::string> warnings;
  return Volume::make(std::move(parts), warnings);
}

}  // namespace

Result<VolumePtr> makePhantom(const std::string& text) {
  const Result<Chosen> chosen = choose(text);
  if (!chosen) return chosen.error();
  return volumeOf(chosen->phantom->make(chosen->size), text);
}

Result<VolumePtr> phantomFrom(const std::string& text, std::vector<std::int16_t> values) {
  const Result<Chosen> chosen = choose(text);
  if (!chosen) return chosen.error();
  if (chosen->phantom->geometry != headGeometry || !areHeadPhantoms(chosen->size, values))
    return Error{"These are no values of phantom \"" + text + "\"."};
  return volumeOf(headPhantom(chosen->size, std::move(values)), text);
}

Result<PhantomHeader> phantomHeader(const std::string& text) {
  const Result<Chosen> chosen = choose(text);
  if (!chosen) return chosen.error();
  const Entry& phantom = *chosen->phantom;
  return PhantomHeader{phantom.geometry(chosen->size), phantom.valueType, phantom.modality};
}

std::vector<std::string> phantomNames() {
  std::vector<std::string> names;
  for (const Entry& entry : phantoms) names.push_back(entry.name);
  return names;
}

}  // namespace volumen
