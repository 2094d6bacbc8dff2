#include "viewer/plan/cost_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "viewer/plan/rule_lines.h"
#include "viewer/plan/visibility.h"
#include "viewer/scene/curve_changes.h"
#include "viewer/scene/step_length.h"

namespace volumen {

namespace {

// Nanoseconds on one core of an AMD EPYC (2.6 GHz, AVX-512), November 2026: stagesMs over samples of `volumen
// render phantom:ct-head:128 --threads 1 --frames 7 --stats`, with 1, 4, 8 and 16 lights, unlit, and each
// shader, method and resampler in turn. Constants of samples and of cell by cell come from whole frames of
// the chest CT (bone, skin and bone, gel), lit and unlit, by `--step` and `--tolerance`. Between these, the
// cost of a visible voxel differs by up to a factor of 3. `bench_choices` checks them all against whole
// frames.
constexpr double sampleNs = 2.6;          // density interpolated at a plain step
constexpr double sampleGradientNs = 1.8;  // gradient at a plain step, in addition
constexpr double intervalNs = 9;          // 2 voxels of planes cell by cell: traversal and densities
constexpr double seenNs = 45;             // visible intervals: the curve, integrated
constexpr double cutNs = 15;              // cuts at a budget of 1, growing with its inverse fourth root
constexpr double litCutNs = 72;           // cuts of lit intervals: gradients, and cuts that follow the light
constexpr double litPlaces = 13;          // lit places on such intervals
constexpr double glSampleNs = 6;          // OpenGL without a GPU, including the transfer to the CPU
constexpr double glGradientNs = 6;        // three more components
constexpr double colourNs = 0.3;          // colour and opacity of a visible sample, composited
constexpr double diffuseNs = 0.15;        // D of one light, directly
constexpr double wholePowerNs = 0.32;     // S of one light with integer shininess: a few multiplications
constexpr double powerNs = 1.3;           // S of one light with another shininess: logarithm and exponential
constexpr double colouredNs = 0.07;       // a light with its own green and blue
constexpr double lookupNs = 4.8;          // bilinear look-up in a map, four nodes of two floats
constexpr double colouredLookupNs = 11;   // bilinear look-up in a coloured map, four nodes of four floats
constexpr double nodeNs = 3.5;            // node of a map, without its lights

double pixelMm(const Camera& camera, glm::ivec2 size) {
  const double height = camera.projection == Projection::parallel
                            ? camera.height
                            : 2 * camera.distance * std::tan(glm::radians(camera.fov) / 2);
  return height / size.y;
}

// Edges of the drawn box in patient space, mm.
struct Box {
  glm::dvec3 edge[3];
  double volume() const { return std::abs(glm::dot(glm::cross(edge[0], edge[1]), edge[2])); }
  double shadow(glm::dvec3 along) const {
    double area = 0;
    for (int n = 0; n < 3; ++n) area += std::abs(glm::dot(glm::cross(edge[n], edge[(n + 1) % 3]), along));
    return area;
  }
};

Box boxOf(const Clip& clip, const VoxelGeometry& geometry) {
  Box box;
  for (int n = 0; n < 3; ++n)
    box.edge[n] = geometry.patientFromVoxelStep[n] * double(geometry.size[n]) *
                  std::max(0.0, clip.boxHigh[n] - clip.boxLow[n]);
  return box;
}

// Number of rays that meet the box and their total length inside, mm.
struct Rays {
  double count = 0, mm = 0;
};

Rays raysOf(const Plan& plan, const VoxelGeometry& geometry) {
  const Camera& camera = *plan.scene.camera;
  const Box box = boxOf(plan.scene.clip, geometry);
  const double shadow = box.shadow(glm::normalize(camera.direction));
  if (!(shadow > 0)) return {};
  const double pixel = pixelMm(camera, plan.options.size);
  const double count = std::min(shadow / (pixel * pixel), double(plan.options.size.x) * plan.options.size.y);
  return {count, count * box.volume() / shadow};
}

// Calls look with the opacities of the minimum, middle and maximum of evenly spread blocks.
template <class Look>
void lookIntoSome(const BlockRanges& blockRanges, const TransferFunction& curve, const Look& look) {
  constexpr std::size_t most = 1024;
  const std::size_t all = blockRanges.size(), looks = std::min(all, most);
  for (std::size_t k = 0; k < looks; ++k) {
    // Multiples of the golden ratio spread evenly; a stride would hit the same columns of blocks again.
    const double place = glm::fract(double(k) * 0.6180339887498949);
    const std::size_t n = looks < all ? std::size_t(place * double(all)) : k;
    const float low = blockRanges.low(n), high = blockRanges.high(n);
    look(std::array{opacityAt(curve, low), opacityAt(curve, (low + high) / 2), opacityAt(curve, high)});
  }
}

// Returns the fraction of visible matter seen before rays become opaque: the depth that rays reach in the
// mean extinction of visible blocks (minimum, middle and maximum) over the visible length per ray.
double seenShare(const Plan& plan, const VolumeFacts& facts, const Rays& rays) {
  const double visibleMmARay = rays.count > 0 ? plan.visibleShare * rays.mm / rays.count : 0;
  if (plan.stopTransmittance <= 0 || !facts.blockRanges || visibleMmARay <= 0) return 1;
  double sum = 0;
  int visible = 0;
  lookIntoSome(*facts.blockRanges, plan.curve, [&](const std::array<double, 3>& opacities) {
    double perMm = 0;
    for (double opacity : opacities)
      perMm -= std::log1p(-std::min(opacity, 0.9999)) / plan.curve.unitDistance / 3;
    sum += perMm;
    visible += perMm > 0;
  });
  if (visible == 0) return 1;
  return std::min(1.0, -std::log(plan.stopTransmittance) / (sum / visible) / visibleMmARay);
}

double lightNs(const Plan& plan, Shader shader, double samples) {
  if (!plan.lit) return 0;
  const Shading& s = plan.scene.shading;
  const bool whole = s.shininess <= 256 && s.shininess == std::floor(s.shininess);
  // Depends on the scene alone, so that `--full` keeps the choice.
  const bool coloured = lightIsColoured(plan.scene);
  const double aLight =
      diffuseNs + (s.specular > 0 ? (whole ? wholePowerNs : powerNs) : 0) + (coloured ? colouredNs : 0);
  const double direct = lightsThatShine(plan.scene) * aLight;
  if (shader == Shader::phong) return samples * direct;
  return samples * (coloured ? colouredLookupNs : lookupNs) +
         6.0 * plan.mapSize * plan.mapSize * (nodeNs + direct);
}

// Returns how finely rays are cut cell by cell, as measured for budgets of 1/3 to 1/2500.
double finenessOf(const Plan& plan) { return 1 / std::sqrt(std::sqrt(plan.errorBudget)); }

// Planes on the CPU: cost per sample, or per two voxels with their parts, when tested and when visible.
struct SampleNs {
  double looked, seen;
};
SampleNs planesNs(const Plan& plan) {
  if (!plan.cellByCell) return {sampleNs + (plan.gradients ? sampleGradientNs : 0), colourNs};
  return {intervalNs, seenNs + (cutNs + (plan.gradients ? litCutNs : 0)) * finenessOf(plan)};
}

}  // namespace

double seenShare(const Plan& plan, const VolumeFacts& facts) {
  return seenShare(plan, facts, raysOf(plan, facts.geometry));
}

double shareInVisibleBlocks(const TransferFunction& curve, const BlockRanges& blockRanges) {
  int looked = 0, seen = 0;
  lookIntoSome(blockRanges, curve, [&](const std::array<double, 3>& opacities) {
    const auto visible = std::ranges::count_if(opacities, [](double opacity) { return opacity > 0; });
    looked += visible > 0 ? 3 : 0;
    seen += int(visible);
  });
  return looked > 0 ? double(seen) / looked : 1;
}

double samplesInBox(const Plan& plan, const VoxelGeometry& geometry) {
  return raysOf(plan, geometry).mm / stepMm(*plan.scene.camera, geometry, plan.stepVoxels);
}

PredictedCost predictedCost(const Plan& plan, const VolumeFacts& facts, Shader shader) {
  const Rays rays = raysOf(plan, facts.geometry);
  const double samples = samplesInBox(plan, facts.geometry);
  if (!(samples > 0)) return {};
  const double visible = samples * plan.visibleShare * seenShare(plan, facts, rays);
  PredictedCost cost;
  if (plan.resampler == Resampler::gl) {
    cost.samplingNs = samples * (glSampleNs + (plan.gradients ? glGradientNs : 0)) + visible * colourNs;
  } else {
    // Rays test blocks in packets, whose box meets more blocks than a single ray.
    const SampleNs ns = planesNs(plan);
    const double looked = std::sqrt(samples * visible);
    cost.samplingNs = looked * ns.looked + visible * ns.seen;
    if (plan.method == Method::blend && plan.stopTransmittance > 0)  // the pass that finds hidden samples
      cost.samplingNs += looked * sampleNs + visible * colourNs;
  }
  const double lit = plan.cellByCell ? visible * litPlaces * finenessOf(plan) : visible;
  cost.lightNs = lightNs(plan, shader, lit);
  return cost;
}

PredictedCost predictedCost(const Plan& plan, const VolumeFacts& facts) {
  return predictedCost(plan, facts, plan.shader);
}

}  // namespace volumen
