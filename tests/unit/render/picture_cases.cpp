#include "tests/unit/render/picture_cases.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "tests/fixtures/real_volume.h"
#include "tests/fixtures/small_volumes.h"

namespace volumen::tests {
namespace {

using glm::dmat3;
using glm::dvec3;

/// Returns soft blobs of 0 .. 1000 plus an asymmetric grain of 40.
double bumpy(dvec3 x) {
  const double blobs = std::sin(0.61 * x.x + 0.3) + std::sin(0.53 * x.y + 1.1) * std::sin(0.47 * x.z) +
                       std::cos(0.4 * (x.x - x.z));
  const double grain = std::sin(12.9898 * x.x + 78.233 * x.y + 37.719 * x.z) * 43758.5453;
  return 500 + 150 * blobs + 40 * (grain - std::floor(grain));
}

VolumePtr made(const std::string& name) {
  const glm::ivec3 size(26, 22, 18);
  const dmat3 turned({0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6});
  if (name == "bumpy") return volumeOf(size, dmat3(1), bumpy);
  if (name == "bumpy anisotropic") return volumeOf(size, dmat3({0.7, 0, 0}, {0, 0.7, 0}, {0, 0, 2.5}), bumpy);
  if (name == "bumpy oblique") return volumeOf(size, turned, bumpy);
  if (name == "bumpy sheared") return volumeOf(size, dmat3({1, 0, 0}, {0.2, 0.9, 0}, {0, 0.8, 1.6}), bumpy);
  if (name == "bumpy left-handed")
    return volumeOf(size, turned * dmat3({-1, 0, 0}, {0, 1.5, 0}, {0, 0, 1}), bumpy);
  if (name == "bumpy, rows apart") return volumeOf<std::int16_t>({256, 18, 15}, dmat3(1), bumpy);
  if (name == "plateaus")  // makes large constant parts with values exactly at curve points
    return volumeOf(size, dmat3(1), [](dvec3 x) { return 100 * std::floor(bumpy(x / 2.0) / 100); });
  return nullptr;
}

double percentile(const Volume& volume, double share) {
  std::vector<float> values(volume.geometry().voxelCount());
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = volume.valueAt(n);
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Building blocks of cases, scaled to one volume.
class Parts {
 public:
  explicit Parts(const Volume& volume)
      : low_(percentile(volume, 0.02)), high_(percentile(volume, 0.998)), g_(volume.geometry()) {
    voxelMm_ = std::cbrt(std::abs(glm::determinant(g_.patientFromVoxelStep)));
    radius_ = glm::length(g_.patientFromVoxelStep * dvec3(g_.size)) / 2;
  }

  double voxelMm() const { return voxelMm_; }
  double radiusMm() const { return radius_; }
  dvec3 centre() const { return g_.patientFromVoxelStep * ((dvec3(g_.size) - 1.0) / 2.0) + g_.origin; }
  float value(double share) const { return float(low_ + share * (high_ - low_)); }

  TransferFunction soft() const {
    return {voxelMm_,
            {{value(0), {0.2, 0.4, 0.9}, 0},
             {value(0.3), {0.9, 0.5, 0.3}, 0},
             {value(0.5), {0.9, 0.6, 0.4}, 0.15},
             {value(0.65), {1, 0.9, 0.7}, 0.03},
             {value(1), {1, 1, 0.9}, 0.9}},
            {}};
  }
  TransferFunction steps() const {
    return {voxelMm_,
            {{value(0.35), {0.8, 0.3, 0.2}, 0},
             {value(0.35), {0.8, 0.3, 0.2}, 0.12},
             {value(0.5), {0.9, 0.5, 0.2}, 0.05},
             {value(0.7), {0.9, 0.5, 0.2}, 0},
             {value(0.7), {0.4, 0.9, 1}, 0.7}},
            {}};
  }
  Camera parallel(dvec3 direction = {-0.62, 0.7, -0.31}) const {
    Camera camera;
    camera.direction = direction;
    camera.height = 1.3 * radius_;
    return camera;
  }
  Camera perspective(dvec3 direction = {0.52, 0.75, 0.33}) const {
    Camera camera = parallel(direction);
    camera.projection = Projection::perspective;
    camera.distance = 2.6 * radius_;
    return camera;
  }
  /// Places the eye inside the volume, a quarter of the radius from the target.
  Camera inside(dvec3 direction = {0.8, -0.5, 0.29}) const {
    Camera camera = perspective(direction);
    camera.distance = 0.25 * radius_;
    camera.fov = 75;
    return camera;
  }
  static std::vector<Light> threeLights() {
    return {{{-0.4, 0.5, 1}, Space::camera, {1, 0.9, 0.8}, 0.8, true},
            {{1, -2, 0.5}, Space::patient, {0.3, 0.5, 1}, 0.6, true},
            {{0, 0, -1}, Space::camera, {0.2, 1, 0.2}, 0.5, true}};
  }

 private:
  double low_, high_, voxelMm_, radius_;
  const VoxelGeometry& g_;
};

Scene sceneOf(TransferFunction transferFunction, Camera camera, std::vector<Light> lights = {Light{}}) {
  Scene scene;
  scene.transferFunction = std::move(transferFunction);
  scene.camera = camera;
  scene.lights = std::move(lights);
  return scene;
}

/// Adds the scene make(parts of the volume), or an empty one if the volume is absent.
template <class Make>
void add(std::vector<PictureCase>& cases, const char* name, const char* volume, Make make) {
  const VolumePtr v = caseVolume(volume);
  cases.push_back({name, volume, v ? make(Parts(*v)) : Scene{}});
}

void addGrids(std::vector<PictureCase>& cases) {
  const auto front = [](const Parts& p) { return sceneOf(p.soft(), p.parallel({0, 1, 0})); };
  const auto parallel = [](const Parts& p) { return sceneOf(p.soft(), p.parallel(), Parts::threeLights()); };
  const auto perspective = [](const Parts& p) { return sceneOf(p.soft(), p.perspective()); };
  const auto inside = [](const Parts& p) { return sceneOf(p.steps(), p.inside(), Parts::threeLights()); };
  add(cases, "isotropic grid, rays along its axis", "bumpy", front);
  add(cases, "isotropic grid, parallel, three lights", "bumpy", parallel);
  add(cases, "isotropic grid, eye inside", "bumpy", inside);
  add(cases, "rows of 2048 bytes, which lie apart", "bumpy, rows apart", [&](const Parts& p) {
    Scene scene = parallel(p);
    scene.camera->height = 40;
    return scene;
  });
  add(cases, "anisotropic grid, parallel", "bumpy anisotropic", parallel);
  add(cases, "anisotropic grid, perspective", "bumpy anisotropic", perspective);
  add(cases, "oblique grid, parallel", "bumpy oblique", parallel);
  add(cases, "oblique grid, perspective", "bumpy oblique", perspective);
  add(cases, "oblique grid, eye inside", "bumpy oblique", inside);
  add(cases, "sheared grid, parallel", "bumpy sheared", parallel);
  add(cases, "sheared grid, perspective", "bumpy sheared", perspective);
  add(cases, "sheared grid, eye inside", "bumpy sheared", inside);
  add(cases, "left-handed grid, parallel", "bumpy left-handed", parallel);
  add(cases, "left-handed grid, perspective", "bumpy left-handed", perspective);
  add(cases, "left-handed grid, eye inside", "bumpy left-handed", inside);
}

void addEffects(std::vector<PictureCase>& cases) {
  const auto effect = [&](const char* name, auto change) {
    add(cases, name, "bumpy anisotropic", [&](const Parts& p) {
      Scene scene = sceneOf(p.soft(), p.perspective());
      change(scene, p);
      return scene;
    });
  };
  effect("no camera, window or floor given", [](Scene& s, const Parts&) { s.camera.reset(); });
  effect("unlit", [](Scene& s, const Parts&) { s.shading.lit = false; });
  effect("no lights: ambient only", [](Scene& s, const Parts&) { s.lights.clear(); });
  effect("a light switched off", [](Scene& s, const Parts&) {
    s.lights = Parts::threeLights();
    s.lights[1].on = false;
  });
  effect("one side", [](Scene& s, const Parts&) { s.shading.sides = 1; });
  effect("local viewer", [](Scene& s, const Parts&) {
    s.shading.localViewer = true;
    s.lights = Parts::threeLights();
  });
  effect("shininess 1", [](Scene& s, const Parts&) { s.shading.shininess = 1; });
  effect("shininess 300, strong", [](Scene& s, const Parts&) {
    s.shading.shininess = 300;
    s.shading.specular = 1;
  });
  effect("gradient floor above every gradient",
         [](Scene& s, const Parts&) { s.shading.gradientFloor = 1e6; });
  effect("gradient floor in the middle", [](Scene& s, const Parts&) { s.shading.gradientFloor = 60; });
  effect("clip box", [](Scene& s, const Parts&) {
    s.clip.boxLow = {0.2, 0.05, 0.3};
    s.clip.boxHigh = {0.77, 0.9, 0.81};
  });
  effect("clip planes that are not unit", [](Scene& s, const Parts& p) {
    s.clip.planes = {{{1, 2, -0.5}, 0.1 * p.radiusMm()}, {{-3, 0.4, 0.2}, 0.3 * p.radiusMm()}};
  });
  effect("empty clip: background alone", [](Scene& s, const Parts& p) {
    s.clip.planes = {{{0, 0, 1}, -10 * p.radiusMm()}};
    s.background.colour = {0.2, 0.4, 0.6};
  });
  effect("coloured background", [](Scene& s, const Parts&) { s.background.colour = {0.9, 0.5, 0.1}; });
  effect("transparent background", [](Scene& s, const Parts&) { s.background.transparent = true; });
  effect("opacity per 2.5 mm", [](Scene& s, const Parts&) { s.transferFunction.unitDistance = 2.5; });
  effect("opacity 1", [](Scene& s, const Parts&) { s.transferFunction.points.back().opacity = 1; });
  effect("one point: constant matter", [](Scene& s, const Parts&) {
    s.transferFunction.points = {{0, {0.3, 0.9, 0.5}, 0.08}};
  });
  effect("gradient opacity", [](Scene& s, const Parts&) {
    s.transferFunction.gradientOpacity = {{15, 0}, {60, 0.4}, {160, 1}};
  });
  effect("gradient opacity, unlit", [](Scene& s, const Parts&) {
    s.shading.lit = false;
    s.transferFunction.gradientOpacity = {{15, 1}, {160, 0}};
  });
  for (const auto& [name, mode] :
       {std::pair{"mip", Mode::mip}, {"minip", Mode::minip}, {"average", Mode::average}})
    effect(name, [mode = mode](Scene& s, const Parts& p) {
      s.mode = mode;
      s.clip.planes = {{{1, 2, -0.5}, 0.1 * p.radiusMm()}};
      s.background.transparent = mode == Mode::average;
    });
  effect("mip in a given window", [](Scene& s, const Parts& p) {
    s.mode = Mode::mip;
    s.window = Window{p.value(0.9), 0.2 * (p.value(1) - p.value(0))};
  });
  add(cases, "curve steps exactly at constant parts", "plateaus", [](const Parts& p) {
    Scene scene = sceneOf(p.soft(), p.parallel());
    scene.transferFunction.points = {{500, {0.9, 0.4, 0.3}, 0},
                                     {500, {0.9, 0.4, 0.3}, 0.2},
                                     {700, {0.9, 0.9, 0.3}, 0},
                                     {700, {0.3, 0.4, 0.9}, 0.9}};
    return scene;
  });
}

/// Returns a scene of bench-scenes, in HU.
Scene benchScene(const Parts& p, const char* name) {
  Scene scene = sceneOf(p.soft(), p.parallel({-0.951251243, -0.167731259, -0.258819045}));
  scene.camera->height = 400;
  scene.shading.specular = 0.3;
  scene.lights = {{{-0.4, 0.5, 1}, Space::camera, {1, 1, 1}, 1, true}};
  scene.transferFunction.unitDistance = 0.78125;
  std::vector<CurvePoint>& points = scene.transferFunction.points;
  if (name == std::string("bone"))
    points = {{150, {1, 0.9, 0.8}, 0}, {350, {1, 0.95, 0.85}, 0.6}, {1200, {1, 1, 0.95}, 0.95}};
  if (name == std::string("gel"))
    points = {{-1024, {0.3, 0.5, 0.9}, 0.001}, {-500, {0.4, 0.7, 0.8}, 0.004}, {0, {0.9, 0.6, 0.4}, 0.006},
              {100, {0.9, 0.4, 0.3}, 0.01},    {300, {1, 0.9, 0.8}, 0.03},     {1500, {1, 1, 1}, 0.06}};
  if (name == std::string("skin-bone")) {
    points = {{-700, {0.9, 0.6, 0.5}, 0}, {-500, {0.9, 0.6, 0.5}, 0.06}, {-150, {0.9, 0.6, 0.5}, 0.06},
              {-50, {0.9, 0.5, 0.4}, 0},  {150, {1, 0.9, 0.8}, 0},       {300, {1, 0.95, 0.85}, 0.7},
              {1500, {1, 1, 1}, 0.95}};
    scene.lights = {{{-0.6, 0.5, 1}, Space::camera, {1, 1, 1}, 0.7, true},
                    {{0.8, -0.2, 0.6}, Space::camera, {1, 1, 1}, 0.5, true}};
  }
  return scene;
}

void addReal(std::vector<PictureCase>& cases) {
  const auto parallel = [](const Parts& p) { return sceneOf(p.soft(), p.parallel(), Parts::threeLights()); };
  const auto inside = [](const Parts& p) { return sceneOf(p.steps(), p.inside()); };
  const char *chest = "ct-chest-lidc0314-138", *head = "mr-head-siemens-gap-175";
  add(cases, "chest CT, bench scene bone", chest, [](const Parts& p) { return benchScene(p, "bone"); });
  add(cases, "chest CT, bench scene gel", chest, [](const Parts& p) { return benchScene(p, "gel"); });
  add(cases, "chest CT, bench scene skin-bone", chest,
      [](const Parts& p) { return benchScene(p, "skin-bone"); });
  add(cases, "chest CT, perspective, transparent, clipped", chest, [](const Parts& p) {
    Scene scene = benchScene(p, "bone");
    scene.camera = p.perspective();
    scene.background.transparent = true;
    scene.clip.planes = {{{-1, 0.3, 0.2}, glm::dot(glm::normalize(dvec3(-1, 0.3, 0.2)), p.centre())}};
    return scene;
  });
  add(cases, "MR head, oblique, parallel, three lights", head, parallel);
  add(cases, "MR head, oblique, eye inside", head, inside);
  add(cases, "float NRRD, parallel", "nrrd-medical/avf_float_32.nrrd", parallel);
  add(cases, "NRRD of many values, eye inside", "nrrd-medical/slicer-BaselineVolume.nrrd", inside);
  add(cases, "sheared NIfTI, parallel", "nifti-meta/niivue/shear.nii.gz", parallel);
  add(cases, "left-handed NIfTI, perspective", "nifti-meta/nibabel/anatomical.nii",
      [](const Parts& p) { return sceneOf(p.steps(), p.perspective()); });
  add(cases, "silicium, one side, steps", "volumes-classic/silicium.mha", [](const Parts& p) {
    Scene scene = sceneOf(p.steps(), p.perspective());
    scene.shading.sides = 1;
    return scene;
  });
}

}  // namespace

VolumePtr caseVolume(const std::string& name) {
  static std::map<std::string, VolumePtr> volumes;
  const auto [entry, isNew] = volumes.try_emplace(name);
  if (isNew && !(entry->second = made(name))) entry->second = realVolume(name);
  return entry->second;
}

const std::vector<PictureCase>& pictureCases() {
  static const std::vector<PictureCase> cases = [] {
    std::vector<PictureCase> all;
    addGrids(all);
    addEffects(all);
    addReal(all);
    return all;
  }();
  return cases;
}

}  // namespace volumen::tests
