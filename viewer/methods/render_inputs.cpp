#include "viewer/methods/render_inputs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "viewer/kernels/ray_generator.h"
#include "viewer/methods/caches.h"
#include "viewer/methods/kept_bricks.h"
#include "viewer/plan/rule_lines.h"
#include "viewer/volume/clock.h"

namespace volumen {

namespace {

LightModel lightOf(const Plan& plan) {
  if (plan.shader == Shader::table) return LightModel::table;
  if (plan.shader == Shader::map)
    return plan.mapLookup == MapLookup::nearest ? LightModel::nearestInMap : LightModel::map;
  return plan.scene.shading.localViewer ? LightModel::localPhong : LightModel::phong;
}

// Returns the largest value of a component of a frame buffer of 8 or 16 bits; 0 for floats.
int levelsOf(Blending blending) {
  return blending == Blending::floats ? 0 : blending == Blending::bits16 ? 65535 : 255;
}

// Returns the total strength of these lights.
LightStrength strengthOf(const Lighting& lighting, std::span<const ShadingLight> lights) {
  glm::vec3 diffuse(0), specular(0);
  for (const ShadingLight& light : lights) diffuse += light.diffuse, specular += light.specular;
  const auto largest = [](glm::vec3 v) { return std::max({v.r, v.g, v.b}); };
  return {lighting.ambient, largest(diffuse), lighting.specular ? largest(specular) : 0.0f,
          lighting.shininess};
}

// Returns the maximum of each strength over single lights.
LightStrength strongestOf(const Lighting& lighting) {
  LightStrength most = strengthOf(lighting, {});
  for (const ShadingLight& light : lighting.lights) {
    const LightStrength one = strengthOf(lighting, {&light, 1});
    most.diffuse = std::max(most.diffuse, one.diffuse);
    most.specular = std::max(most.specular, one.specular);
  }
  return most;
}

// Returns the extent of the box around a packet of rays, in blocks. It covers the interval, plus half a step
// to either side if samples stand at steps (RayRow::ahead), or the steps of one look together.
int reachBlocks(const Plan& plan, const RayGenerator& setup, int edge) {
  // One length serves all short steps and cells, so that they share a map.
  const double along =
      plan.cellByCell ? plan.stepVoxels : std::max(double(EmptySpaceMap::longestLook), 2 * plan.stepVoxels);
  const double across = 2 * setup.tileSpread() + along + 0.1;
  return int(std::clamp(std::ceil(across / edge), 1.0, 32.0 / edge));
}

// Returns 1 / unitDistance, limited so that no ray is longer than 1e30 unit distances. Only opacities below
// 1e-27 would show a difference. Projections have no opacity.
float inverseUnitOf(const Plan& plan, const VoxelGeometry& geometry) {
  if (plan.scene.mode != Mode::composite) return 1;
  const double longestMm = glm::dot(geometry.spacing(), glm::dvec3(geometry.size));
  // Over longer unit distances nothing shows, whatever the curve.
  const double least = 1e-12 / longestMm;
  return float(std::max(least, std::min({1 / plan.curve.unitDistance, 1e30 / longestMm, 1e37})));
}

}  // namespace

RenderInputs::RenderInputs(const Plan& plan, RenderCaches& caches, RenderStats& stats)
    : key_(kernelKey(plan)),
      brightest_(float(std::max(1.0, volumen::brightest(plan.scene)))),
      lighting_(makeLighting(plan.scene, plan.specular, plan.colouredLight)),
      transfer_(plan.curve) {
  StoredVoxels& voxels = *caches.impl().voxels;
  const double begin = wallMs();
  inputs_.size = voxels.volume()->size();
  inputs_.densityRow = inputs_.gradientRow = inputs_.size.x;
  readStored(plan, caches, stats);
  stats.gradientsMs += wallMs() - begin;
  curve_ = makeCurveTable(transfer_, scale_);
  inputs_.curve = &curve_;
  inputs_.transfer = &transfer_;
  inputs_.inverseUnitMm = inverseUnitOf(plan, voxels.volume()->geometry());
  const RayGenerator setup(plan, voxels.volume()->geometry());
  double mostOpacity = 0;
  for (const CurvePoint& p : transfer_.points) mostOpacity = std::max(mostOpacity, double(p.opacity));
  inputs_.intervals = makeCorrectionSeries(setup.sharedStepMm() * inputs_.inverseUnitMm, mostOpacity);
  inputs_.light = lightOf(plan);
  inputs_.lighting = &lighting_;
  inputs_.lightStrength = strengthOf(lighting_, lighting_.lights);
  inputs_.strongestLight = strongestOf(lighting_);
  setFactorUnit();
  makeShades(plan, caches);
  inputs_.stopTransmittance = float(plan.stopTransmittance);
  inputs_.slices = {plan.method == Method::blend, float(levelsOf(plan.blending))};
  const VolumeFacts& facts = voxels.facts();
  if (plan.skipBlocks && plan.scene.mode != Mode::composite)
    blocks_ = {facts.blockRanges.get(), scale_.slope, scale_.intercept,
               1e-6 * largestRounded(plan, facts.range), plan.bits != 32};
  else
    readBlocks(plan, reachBlocks(plan, setup, facts.blockRanges->edge), caches, stats);
  const auto& cells = caches.impl().segmentCellsOf(plan.segments ? shownSegments(plan.scene)
                                                                 : std::vector<const SegmentSurface*>());
  if (plan.segments) segments_.emplace(plan, voxels.volume()->geometry(), cells);
  for (const auto& c : cells) stats.blockBytes += c->bytes();
  stats.tableBytes =
      curve_.bytes() + (inputs_.map ? inputs_.map->nodes.size() * sizeof(float) : 0) + table_.bytes();
  stats.blockBytes += facts.blockRanges->bytes();
}

void RenderInputs::setFactorUnit() {
  const auto& points = transfer_.gradientOpacity;
  if (points.empty() || !(points.back().gradient > 0)) return;
  constexpr double most = std::numeric_limits<float>::max();
  const double unit = std::clamp<double>(points.back().gradient, 1 / most, most / 4);
  inputs_.factorUnit = float(unit);
  inputs_.factorUnitsAStored = float(std::min(inputs_.gradientUnit / unit, most));
}

double RenderInputs::largestRounded(const Plan& plan, ValueRange range) const {
  if (plan.bits == 32) return std::max(std::abs(scale_.low), std::abs(scale_.high));
  return std::max(std::abs(range.low), std::abs(range.high)) / scale_.slope;
}

void RenderInputs::readBlocks(const Plan& plan, int reach, RenderCaches& caches, RenderStats& stats) {
  const bool asksCells = key_.sampling != Sampling::dense;
  if (plan.skipBlocks || asksCells) {
    const auto& skip =
        caches.impl().skipOf(transfer_, curve_, {transfer_.points, reach, rounding_, densities_, asksCells});
    stats.blockBytes = skip.bytes();
    if (plan.skipBlocks) inputs_.skip = &skip.map();
    if (asksCells) inputs_.cells = &skip.cells;
    inputs_.budget.most = float(plan.errorBudget);
  }
}

void RenderInputs::readStored(const Plan& plan, RenderCaches& caches, RenderStats& stats) {
  if (plan.bits == 8) return readBytes(plan, caches, stats);
  StoredVoxels& voxels = *caches.impl().voxels;
  const VoxelGeometry& geometry = voxels.volume()->geometry();
  if (plan.bits == 16) {
    const Density16& d = voxels.densities16();
    scale_ = d.scale;
    inputs_.density16 = d.data;
    inputs_.flip16 = d.flip;
    densities_ = {.in16 = d.data, .flip = std::uint16_t(d.flip), .rowVoxels = inputs_.densityRow};
    stats.densityBytes = std::size_t(geometry.voxelCount()) * 2;
    if (!plan.gradients) return;
    if (const auto kept = voxels.sparesGradients() ? bricksToKeep(plan, voxels.facts()) : std::nullopt) {
      const GradientBricks16& b = voxels.gradientsOfBricks(*kept);
      inputs_.voxels16 = b.xyzd.data();
      inputs_.bricks = b.first.data();
      stats.gradientBytes = b.bytes();
      return setGradientScale(plan, geometry, b.scale);
    }
    const Gradients16& g = voxels.gradientsIn16(plan.gradientOperator);
    inputs_.voxels16 = g.xyzd.data();
    inputs_.gradientRow = g.rowVoxels;
    stats.gradientBytes = g.xyzd.bytes();
    setGradientScale(plan, geometry, g.scale);
    return;
  }
  const Density32& d = voxels.densities32();
  scale_ = d.scale;
  inputs_.density32 = d.data;
  stats.densityBytes = std::size_t(geometry.voxelCount()) * 4;
  if (!plan.gradients) return;
  const Gradients32& g = voxels.gradientsIn32(plan.gradientOperator);
  inputs_.gradients32 = g.xyz0.data();
  stats.gradientBytes = g.xyz0.bytes();
  setGradientScale(plan, geometry, g.scale);
}

void RenderInputs::readBytes(const Plan& plan, RenderCaches& caches, RenderStats& stats) {
  StoredVoxels& voxels = *caches.impl().voxels;
  stats.densityBytes = std::size_t(voxels.volume()->geometry().voxelCount());
  const auto useScale = [&](const ByteScale& s) {
    scale_ = {s.unit, s.low, 0, (voxels.facts().range.high - s.low) / s.unit};
    // Slightly more than half a unit, because values are rounded to floats before and after.
    rounding_ = s.exact ? 0 : 0.501 * s.unit;
  };
  if (!plan.gradients) {
    const Density8& d = voxels.densitiesIn8();
    inputs_.density8 = d.bytes.data();
    densities_ = {.in8 = d.bytes.data(), .rowVoxels = inputs_.densityRow};
    return useScale(d.scale);
  }
  const Voxels8& v = voxels.voxelsIn8(plan.gradientOperator);
  inputs_.voxels8 = v.words.data();
  inputs_.densityRow = inputs_.gradientRow = v.rowVoxels;
  densities_ = {.in8 = reinterpret_cast<const std::uint8_t*>(v.words.data()) + 3,
                .stride8 = 4,
                .rowVoxels = v.rowVoxels};
  stats.gradientBytes = v.words.bytes() - stats.densityBytes;
  useScale(v.scale);
  setGradientScale(plan, voxels.volume()->geometry(), v.gradientUnit);
}

void RenderInputs::makeShades(const Plan& plan, RenderCaches& caches) {
  if (plan.shader == Shader::map)
    inputs_.map = &caches.impl().reflectanceMap(lighting_, plan.mapSize, plan.mapLookup);
  if (plan.shader != Shader::table) return;
  ShadeTableInput in{{}, inputs_.inverseFloor, 1, scale_};
  for (int n = 0; n < 9; ++n) in.gradientMatrix[n] = inputs_.gradientMatrix[n] * inputs_.gradientUnit;
  const ValueRange values = caches.facts().range;
  // A Sobel component is half the difference of two means of values (picture.md 3).
  in.gradientLimit = (values.high - values.low) / 2 / gradientScale_;
  table_ = makeShadeTable(lighting_, curve_, in);
  inputs_.table = &table_;
}

void RenderInputs::setGradientScale(const Plan& plan, const VoxelGeometry& geometry, double scale) {
  gradientScale_ = scale;
  const glm::dmat3 m = geometry.patientFromVoxelGradient() * scale;
  double largest = 0, smallest = std::numeric_limits<double>::max();
  for (int c = 0; c < 3; ++c) {
    const double length = glm::length(m[c]);
    largest = std::max(largest, length);
    smallest = std::min(smallest, length);
  }
  // Powers of two, so that no unit causes rounding. Magnitudes are real values per mm. Where those would
  // exceed the range of floats, they are multiples of `real`.
  const double unit = std::exp2(std::ceil(std::log2(largest))), kept = std::clamp(unit, 0x1p-60, 0x1p60),
               real = unit / kept;
  inputs_.gradientUnit = float(kept);
  inputs_.boundedGradients = plan.bits != 32 && smallest > 1e-8 * largest;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) inputs_.gradientMatrix[3 * r + c] = float(m[c][r] / unit);
  const double floor = *plan.scene.shading.gradientFloor;
  inputs_.inverseFloor = floor > 0 ? float(std::min(real / floor, 1e30)) : 0.0f;
  for (GradientOpacityPoint& p : transfer_.gradientOpacity) p.gradient = std::min(p.gradient / real, 1e30);
}

void preparePicture(const Plan& plan, Picture& picture) {
  picture.size = plan.options.size;
  picture.transparent = plan.scene.background.transparent;
  picture.rgba.resize(std::size_t(4) * picture.size.x * picture.size.y);
}

void writePixels(const Background& background, const RayRow& rays, const TraceRow& row, Picture& picture) {
  const glm::vec3 behind(background.transparent ? glm::dvec3(0) : background.colour);
  for (std::size_t ray = 0; ray < rays.pixel.size(); ++ray) {
    if (rays.pixel[ray] < 0) continue;
    float* rgba = &picture.rgba[std::size_t(4) * rays.pixel[ray]];
    const float a = std::min(row.alpha[ray], 1.0f), through = 1 - a;
    const glm::vec3 c(row.red[ray], row.green[ray], row.blue[ray]);
    for (int n = 0; n < 3; ++n) rgba[n] = std::clamp(c[n] + through * behind[n], 0.0f, 1.0f);
    rgba[3] = background.transparent ? a : 1.0f;
  }
}

void roundPixels(Blending blending, const RayRow& rays, Picture& picture) {
  const int levels = levelsOf(blending);
  if (levels == 0) return;
  for (int pixel : rays.pixel)
    for (int c = 0; pixel >= 0 && c < 4; ++c) {
      float& x = picture.rgba[std::size_t(4) * pixel + c];
      x = float(int(x * float(levels) + 0.5f)) / float(levels);
    }
}

void writeProjectedPixels(const Scene& scene, const DensityScale& scale, const RayRow& rays,
                          const float* density, Picture& picture) {
  const Window& w = *scene.window;
  for (std::size_t ray = 0; ray < rays.pixel.size(); ++ray) {
    if (rays.pixel[ray] < 0) continue;
    float* rgba = &picture.rgba[std::size_t(4) * rays.pixel[ray]];
    const bool hit = rays.steps[ray] > 0;
    const double value = scale.slope * density[ray] + scale.intercept;
    const float grey = float(std::clamp((value - (w.centre - w.width / 2)) / w.width, 0.0, 1.0));
    const bool clear = !hit && scene.background.transparent;
    for (int n = 0; n < 3; ++n) rgba[n] = hit ? grey : clear ? 0.0f : float(scene.background.colour[n]);
    rgba[3] = clear ? 0.0f : 1.0f;
  }
}

}  // namespace volumen
