// Hard matter: no gradient to shade by, opacities at both ends of their range, plates thinner than the
// gradient.
#include <cmath>
#include <glm/trigonometric.hpp>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/hard/hard_cases.h"

namespace volumen::tests {
namespace {

using glm::dmat3;
using glm::dvec3;
using glm::dvec4;
using glm::ivec3;

constexpr dvec3 colour(0.9, 0.5, 0.3);

VolumePtr constantVolume(ivec3 size = ivec3(20), double mm = 1) {
  return volumeOf(size, dmat3(mm), [](dvec3) { return 40; });
}

/// Returns a case with the same matter everywhere, on a transparent background.
HardCase uniform(const char* name, VolumePtr volume, double opacity, double brightness = 1) {
  HardCase c{.name = name, .volume = volume, .scene = sceneOf(*volume, {{0, colour, opacity}})};
  c.scene.transferFunction.unitDistance = 1;
  c.scene.shading.lit = brightness != 1;
  c.scene.background.transparent = true;
  // Opacity is limited to 1 - 2^-20 (picture.md 4).
  const double muPerMm = -std::log1p(-std::min(opacity, 1 - std::ldexp(1, -20)));
  c.closedForm = [=](double mm) {
    const double alpha = -std::expm1(-muPerMm * mm);
    return dvec4(colour * brightness * alpha, alpha);
  };
  c.uniform = true;
  c.delicate = true;
  return c;
}

void addUniform(HardCases& cases) {
  cases.addBoth(uniform("homogeneous cube, opacity 0.03", constantVolume(), 0.03));
  cases.addBoth(uniform("homogeneous cube, opacity 0.002", constantVolume(ivec3(40)), 0.002));
  // There is no gradient anywhere. picture.md 5's q is 0, and D'' = ambient + diffuse / 2.
  cases.addBoth(uniform("constant volume, lit", constantVolume(), 0.05, 0.2 + 0.7 / 2));
  HardCase c = uniform("constant volume, lit, gradient floor 1e-30", constantVolume(), 0.05, 0.2 + 0.7 / 2);
  c.scene.shading.gradientFloor = 1e-30;
  cases.addBoth(c);
  cases.addBoth(uniform("opacity 0", constantVolume(), 0));
  cases.addBoth(uniform("opacity 1", constantVolume(), 1));
  cases.addBoth(uniform("opacity 1 - 1e-7", constantVolume(), 1 - 1e-7));
  for (const auto& [name, unitMm] : {std::pair{"opacity 1 per 1e-6 mm", 1e-6},
                                     {"opacity 1 per 1e-39 mm", 1e-39},
                                     {"opacity 1 per 1e-300 mm", 1e-300}}) {
    c = uniform(name, constantVolume(), 1);
    c.scene.transferFunction.unitDistance = unitMm;
    c.closedForm = [](double mm) { return dvec4(colour, 1) * (mm > 0 ? 1.0 : 0.0); };
    cases.addBoth(c);
  }
  HardCase soft{.name = "soft curve per 1e-39 mm",
                .volume = wavesVolume(),
                .scene = sceneOf(*wavesVolume(), softCurve(0, 1000)),
                .finiteOnly = "whatever shows is opaque at once, and plain steps are off by a step",
                .delicate = true};
  soft.scene.transferFunction.unitDistance = 1e-39;
  cases.addBoth(soft);

  // Rays pass all 10^4 voxels. With voxels of 100 mm a ray absorbs one tenth of the light, and a sample
  // 10^-5.
  for (const auto& [name, mm] : {std::pair{"opacity 1e-7 per mm, 10^4 samples of 1 mm", 1.0},
                                 {"opacity 1e-7 per mm, 10^4 samples of 100 mm", 100.0}}) {
    c = uniform(name, constantVolume({2, 2, 10000}, mm), 1e-7);
    c.size = {2, 2};
    c.scene.camera->direction = {0, 0, 1};
    c.scene.camera->up = {0, 1, 0};
    c.scene.camera->height = mm;
    cases.add(c);
  }
}

/// Adds curves with a step exactly at the value of all voxels. The last point at that value applies.
void addStepAtTheValue(HardCases& cases) {
  HardCase c = uniform("step exactly on the stored value of everything", constantVolume(), 0.1);
  std::vector<CurvePoint>& points = c.scene.transferFunction.points;
  points = {{0, {0, 1, 0}, 0.7}, {40, {0, 1, 0}, 0.7}, {40, colour, 0.1}, {90, {0, 0, 1}, 0.9}};
  cases.addBoth(c);
  c.name = "three points on the stored value of everything";
  points.insert(points.begin() + 2, {40, {1, 0, 1}, 1});
  cases.addBoth(c);
  c.name = "step one float above the stored value of everything";
  const float above = std::nextafter(40.0f, 41.0f);
  points = {{0, colour, 0.1}, {above, colour, 0.1}, {above, {0, 0, 1}, 0.9}, {90, {0, 0, 1}, 0.9}};
  cases.addBoth(c);
  c.name = "opaque step one float above the stored value of everything";
  points = {{above, colour, 0}, {above, {0, 0, 1}, 1}};
  c.closedForm = [](double) { return dvec4(0); };
  cases.addBoth(c);
}

/// Returns a ramp of half a unit a voxel beside a few spikes of the full 16-bit range. Sobel gradients of the
/// spikes are about 30 000 a voxel. 16-bit integers of that range cannot distinguish the ramp's gradient from
/// zero.
VolumePtr gentleRampWithSpikes() {
  VolumeParts parts;
  parts.geometry.size = ivec3(30);
  parts.geometry.origin = dvec3(-14.5);
  std::vector<std::int16_t> values;
  for (int k = 0; k < 30; ++k)
    for (int j = 0; j < 30; ++j)
      for (int i = 0; i < 30; ++i) values.push_back(std::int16_t((i + 2 * j) / 4));
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) {
      values[std::size_t(k * 30 + j) * 30 + 0] = 32767;
      values[std::size_t(k * 30 + j) * 30 + 2] = -32768;
    }
  parts.values = std::move(values);
  std::vector<std::string> warnings;
  return *Volume::make(std::move(parts), warnings);
}

void addGradients(HardCases& cases) {
  const VolumePtr ramp = gentleRampWithSpikes();
  HardCase c{.name = "gradients below the packing step",
             .volume = ramp,
             .scene = sceneOf(*ramp, {{2, {0.9, 0.7, 0.5}, 0.01}, {20, {1, 1, 1}, 0.1}}, {0.2, 1, 0.1}),
             .delicate = true};
  c.scene.clip.boxLow = {0.2, 0.2, 0.2};  // the spikes are not in view
  cases.addBoth(c);

  const VolumePtr plateaus =
      volumeOf({20, 18, 16}, dmat3(1), [](dvec3 x) { return 100 * std::floor(10 * waves(x / 2.0)); });
  c = {.name = "plateaus with curve steps on their values",
       .volume = plateaus,
       .scene = sceneOf(*plateaus, {{400, {0.9, 0.4, 0.3}, 0},
                                    {400, {0.9, 0.4, 0.3}, 0.2},
                                    {600, {0.9, 0.9, 0.3}, 0},
                                    {600, {0.3, 0.4, 0.9}, 0.9}}),
       .delicate = true};
  cases.addBoth(c);
  c.name = "plateaus, gradient floor 1e-6";
  c.scene.shading.gradientFloor = 1e-6;
  cases.addBoth(c);
  c.name = "plateaus, gradient opacity over gradients of none";
  c.scene.shading.gradientFloor.reset();
  c.scene.transferFunction.gradientOpacity = {{0, 0}, {0, 0.5}, {60, 0.5}, {60, 1}};
  cases.addBoth(c);
}

/// Returns a plate across y, `thick` voxels thick, seen at `degrees` to its normal. The gradient reverses
/// within the plate.
HardCase plate(const std::string& name, int thick, double degrees) {
  const VolumePtr volume =
      volumeOf({20, 20, 20}, dmat3(1), [=](dvec3 x) { return x.y >= 9 && x.y < 9 + thick ? 1000 : 0; });
  const double turn = glm::radians(degrees);
  return {.name = name,
          .volume = volume,
          .scene = sceneOf(*volume, {{200, {0.9, 0.7, 0.5}, 0}, {800, {1, 1, 0.9}, 0.5}},
                           {std::sin(turn) * 0.8, std::cos(turn), std::sin(turn) * 0.6}),
          .delicate = true};
}

void addPlates(HardCases& cases) {
  cases.addBoth(plate("plate of one voxel, face-on", 1, 0));
  cases.addBoth(plate("plate of two voxels, face-on", 2, 0));
  cases.addBoth(plate("plate of one voxel, 2 degrees off", 1, 2));
  cases.addBoth(plate("plate of one voxel, nearly edge-on", 1, 88));
  HardCase c = plate("plate of one voxel, face-on, strong highlight", 1, 0);
  c.scene.shading.specular = 1;
  c.scene.shading.shininess = 60;
  cases.addBoth(c);
  c = plate("plate of one voxel, face-on, opaque step", 1, 0);
  c.scene.transferFunction.points = {{500, {0.9, 0.7, 0.5}, 0}, {500, {0.9, 0.7, 0.5}, 1}};
  cases.addBoth(c);
}

}  // namespace

void addMatterCases(HardCases& cases) {
  addUniform(cases);
  addStepAtTheValue(cases);
  addGradients(cases);
  addPlates(cases);
}

}  // namespace volumen::tests
