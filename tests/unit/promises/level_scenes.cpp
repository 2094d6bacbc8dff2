#include "tests/unit/promises/level_scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "tests/fixtures/real_volume.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/scene/presets.h"
#include "viewer/volume/histogram.h"

namespace volumen::tests {
namespace {

using glm::dvec3;

/// Returns the percentiles P2 .. P99.8.
ValueRange usual(const Volume& volume) {
  const std::vector<float> ends = percentiles(volume, {20, 998});
  return {ends[0], ends[1]};
}

float valueOf(const Volume& volume, double share) {
  const ValueRange range = usual(volume);
  return float(range.low + share * (range.high - range.low));
}

/// On CT, a preset made for CT keeps its HU. On other volumes its curve up to 1500 HU is stretched over the
/// volume's usual values.
Scene preset(const char* name, const Volume& volume) {
  Scene scene = *presetScene(name, volume);
  if (volume.attributes().modality == "CT" || std::string(name).starts_with("MR")) return scene;
  std::vector<CurvePoint>& points = scene.transferFunction.points;
  const double low = std::max(-1000.0, double(points.front().value));
  const double high = std::min(1500.0, double(points.back().value));
  for (CurvePoint& p : points) p.value = valueOf(volume, (double(p.value) - low) / (high - low));
  return scene;
}

Scene made(std::vector<CurvePoint> points, const Volume& volume) {
  Scene scene;
  scene.transferFunction.points = std::move(points);
  for (CurvePoint& p : scene.transferFunction.points) p.value = valueOf(volume, double(p.value));
  scene.transferFunction.unitDistance = std::cbrt(volume.geometry().voxelVolume());
  return scene;
}

double radiusOf(const Volume& volume) {
  const VoxelGeometry& g = volume.geometry();
  return glm::length(g.patientFromVoxelStep * dvec3(g.size)) / 2;
}

/// Sets a camera along `direction` at a point near the centre, chosen without symmetry. `share` of the whole
/// box is in view.
Scene seen(Scene scene, const Volume& volume, dvec3 direction, double share,
           Projection projection = Projection::parallel) {
  Camera camera;
  camera.direction = direction;
  camera.up = {0.13, 0.21, 1};
  camera.projection = projection;
  camera = fitCamera(camera, volume.geometry(), 1);
  camera.height *= share;
  camera.fov *= share;
  *camera.target += radiusOf(volume) * dvec3(0.031, -0.023, 0.041);
  scene.camera = camera;
  return scene;
}

/// Places the eye inside the volume, a fifth of its radius from the target.
Scene fromInside(Scene scene, const Volume& volume, dvec3 direction) {
  scene = seen(std::move(scene), volume, direction, 1, Projection::perspective);
  scene.camera->distance = 0.2 * radiusOf(volume);
  scene.camera->fov = 80;
  return scene;
}

Scene muscleCut(const Volume& v) {
  Scene scene = seen(preset("CT-Muscle", v), v, {-0.4, 0.8, -0.3}, 0.8);
  scene.clip.boxLow = {0.11, 0.07, 0.13};
  scene.clip.boxHigh = {0.83, 1, 0.79};
  const dvec3 normal = glm::normalize(dvec3(1, -1.3, 0.4));
  scene.clip.planes = {{normal, glm::dot(normal, v.geometry().centre()) + 0.1 * radiusOf(v)}};
  return scene;
}

Scene gradientEdges(const Volume& v) {
  Scene scene = seen(preset("CT-Cardiac", v), v, {0.7, 0.6, 0.2}, 0.7);
  const ValueRange range = usual(v);
  const double edge = (range.high - range.low) / std::cbrt(v.geometry().voxelVolume());
  scene.transferFunction.gradientOpacity = {{0.01 * edge, 0}, {0.06 * edge, 0.3}, {0.2 * edge, 1}};
  return scene;
}

Scene narrowPeaks(const Volume& v) {
  std::vector<CurvePoint> points;
  const dvec3 colours[] = {{0.9, 0.3, 0.2}, {0.2, 0.8, 0.4}, {0.3, 0.4, 1}, {1, 0.9, 0.3}, {0.9, 0.9, 0.9}};
  for (int n = 0; n < 5; ++n) {
    const double centre = 0.22 + 0.17 * n;  // each peak is half a per cent of the range wide on each side
    points.push_back({float(centre - 0.005), colours[n], 0});
    points.push_back({float(centre), colours[n], 0.5});
    points.push_back({float(centre + 0.005), colours[n], 0});
  }
  return seen(made(points, v), v, {0.3, -0.9, -0.25}, 0.9);
}

std::vector<CurvePoint> sharpSteps() {
  return {{0.3f, {0.8, 0.4, 0.3}, 0},   {0.3f, {0.8, 0.4, 0.3}, 0.06}, {0.5f, {0.8, 0.4, 0.3}, 0.06},
          {0.5f, {0.3, 0.9, 0.9}, 0.3}, {0.7f, {0.3, 0.9, 0.9}, 0.3},  {0.7f, {1, 0.95, 0.8}, 0.95}};
}

Scene opaqueSurface(const Volume& v) {
  return seen(made({{0.45f, {0.9, 0.7, 0.5}, 0}, {0.45f, {0.9, 0.7, 0.5}, 1}, {1, {1, 1, 1}, 1}}, v), v,
              {-0.8, -0.45, 0.35}, 0.8);
}

Scene manyLights(const Volume& v) {
  Scene scene = seen(preset("CT-Chest-Vessels", v), v, {0.1, 0.95, -0.35}, 0.8);
  scene.shading.specular = 0.6;
  scene.shading.shininess = 60;
  scene.lights.clear();
  for (int n = 0; n < 9; ++n) {
    const double turn = 2.4 * n, z = 1 - (n + 0.5) / 4.5;
    scene.lights.push_back({{std::cos(turn), std::sin(turn), z},
                            n % 2 ? Space::camera : Space::patient,
                            {0.5 + 0.5 * (n % 3) / 2, 0.7, 1 - 0.4 * (n % 4) / 3},
                            0.3,
                            true});
  }
  return scene;
}

Scene sharpHighlight(const Volume& v) {
  Scene scene = seen(preset("MR-T2-Brain", v), v, {-0.6, 0.35, 0.5}, 0.6);
  scene.shading.specular = 1;
  scene.shading.shininess = 400;
  return scene;
}

Scene colouredFog(const Volume& v) {
  Scene scene = seen(made({{0, {0.2, 0.4, 0.9}, 0.002},
                           {0.3f, {0.9, 0.8, 0.3}, 0.02},
                           {0.6f, {0.3, 0.9, 0.4}, 0.01},
                           {1, {1, 0.3, 0.3}, 0.08}},
                          v),
                     v, {0.55, 0.6, -0.58}, 1);
  scene.shading.lit = false;
  scene.background.colour = {0.9, 0.95, 1};
  return scene;
}

Scene projection(const Volume& v, Mode mode) {
  Scene scene = seen(Scene{}, v, {0.45, 0.8, -0.4}, 0.8);
  scene.mode = mode;
  return scene;
}

}  // namespace

const std::vector<LevelScene>& levelScenes() {
  static const std::vector<LevelScene> scenes = {
      {"preset CT-Cardiac3, transparent",
       [](const Volume& v) {
         Scene scene = seen(preset("CT-Cardiac3", v), v, {-0.5, 0.7, -0.5}, 0.8);
         scene.background.transparent = true;
         return scene;
       }},
      {"preset CT-Pulmonary-Arteries in perspective",
       [](const Volume& v) {
         return seen(preset("CT-Pulmonary-Arteries", v), v, {0.6, 0.7, 0.3}, 0.8, Projection::perspective);
       }},
      {"preset CT-Muscle, cut by box and plane", muscleCut},
      {"preset MR-Default from the left",
       [](const Volume& v) {
         return seen(preset("MR-Default", v), v, {-1, 0, 0}, 0.9);
       }},
      {"preset CT-Air, one side",
       [](const Volume& v) {
         Scene scene = seen(preset("CT-Air", v), v, {0.3, 0.9, 0.3}, 0.6);
         scene.clip.boxLow = {0.2, 0.3, 0};
         scene.shading.sides = 1;
         return scene;
       }},
      {"preset CT-Soft-Tissue: opacity 1, unlit",
       [](const Volume& v) {
         return seen(preset("CT-Soft-Tissue", v), v, {0.2, 0.9, -0.4}, 0.8);
       }},
      {"preset CT-Cardiac with gradient opacity", gradientEdges},
      {"the window's first picture of bones: thin noise before and behind",
       [](const Volume& v) {
         return seen(preset("CT-Bones", v), v, {0, 1, 0}, 1);
       }},
      {"preset CT-Chest-Contrast-Enhanced from the front",
       [](const Volume& v) {
         return seen(preset("CT-Chest-Contrast-Enhanced", v), v, {0, 1, 0}, 1);
       }},
      {"inside, local viewer, preset CT-Lung",
       [](const Volume& v) {
         Scene scene = fromInside(preset("CT-Lung", v), v, {0.7, 0.6, -0.2});
         scene.shading.localViewer = true;
         return scene;
       }},
      {"inside, sharp steps",
       [](const Volume& v) {
         return fromInside(made(sharpSteps(), v), v, {-0.5, -0.6, 0.6});
       }},
      {"narrow peaks", narrowPeaks},
      {"sharp steps, perspective",
       [](const Volume& v) {
         return seen(made(sharpSteps(), v), v, {-0.7, 0.5, -0.4}, 0.8, Projection::perspective);
       }},
      {"opaque surface", opaqueSurface},
      {"9 lights, preset CT-Chest-Vessels", manyLights},
      {"shininess 400, preset MR-T2-Brain", sharpHighlight},
      {"coloured fog, unlit", colouredFog},
      {"close up, sharp steps",
       [](const Volume& v) {
         return seen(made(sharpSteps(), v), v, {0.25, 0.85, 0.45}, 0.06);
       }},
      {"mip", [](const Volume& v) { return projection(v, Mode::mip); }},
      {"average", [](const Volume& v) { return projection(v, Mode::average); }},
  };
  return scenes;
}

const std::vector<std::string>& levelVolumes() {
  static const std::vector<std::string> names = {"ct-chest-lidc0314-138", "mr-head-siemens-gap-175",
                                                 "phantom:ct-head:96", "phantom:marschner-lobb"};
  return names;
}

VolumePtr levelVolume(const std::string& name) {
  static std::map<std::string, VolumePtr> volumes;
  const auto [entry, isNew] = volumes.try_emplace(name);
  if (!isNew) return entry->second;
  return entry->second = name.starts_with("phantom:") ? *makePhantom(name.substr(8)) : realVolume(name);
}

}  // namespace volumen::tests
