// Hard lights: along and against the normal, exactly behind the matter, highlights of every width.
#include <cmath>

#include "tests/unit/hard/hard_cases.h"

namespace volumen::tests {
namespace {

using glm::dvec3;

/// Adds a change of the light over two volumes: the ramp, whose normal faces the viewer, and waves.
void addOverBoth(HardCases& cases, const std::string& name, void (*change)(Scene&)) {
  const VolumePtr ramp = rampVolume(), wavy = wavesVolume();
  HardCase onRamp{.name = name + ", on a ramp",
                  .volume = ramp,
                  .scene = sceneOf(*ramp, {{0, {0.8, 0.5, 0.3}, 0}, {1900, {1, 0.9, 0.7}, 0.4}}, {0, 1, 0}),
                  .delicate = true};
  HardCase onWaves{.name = name + ", on waves", .volume = wavy, .scene = sceneOf(*wavy, softCurve(0, 1000))};
  for (HardCase* c : {&onRamp, &onWaves}) {
    change(c->scene);
    if (c->scene.lights.size() > 9) c->size = {6, 6};  // the reference is slow
    cases.addBoth(*c);
  }
}

void addLight(Scene& scene, dvec3 direction, double shininess = 20) {
  scene.lights = {{direction, Space::camera, {1, 0.9, 0.8}, 1, true}};
  scene.shading.specular = 0.8;
  scene.shading.shininess = shininess;
}

}  // namespace

void addLightCases(HardCases& cases) {
  addOverBoth(cases, "light along the view", [](Scene& s) { addLight(s, {0, 0, 1}); });
  addOverBoth(cases, "light exactly behind", [](Scene& s) { addLight(s, {0, 0, -1}); });
  addOverBoth(cases, "light nearly behind", [](Scene& s) { addLight(s, {1.01e-3, 0, -1}); });
  addOverBoth(cases, "light behind, one side", [](Scene& s) {
    addLight(s, {0, 0, -1});
    s.shading.sides = 1;
  });
  addOverBoth(cases, "light from the side", [](Scene& s) { addLight(s, {1, 0, 0}); });
  addOverBoth(cases, "light against the normal in patient space", [](Scene& s) {
    s.lights = {{{0, 1e-90, 0}, Space::patient, {1, 1, 1}, 1, true}};
    s.shading.sides = 1;
  });
  addOverBoth(cases, "shininess 1", [](Scene& s) { addLight(s, {0.3, 0.2, 1}, 1); });
  addOverBoth(cases, "shininess 10^4", [](Scene& s) { addLight(s, {0, 0, 1}, 1e4); });
  addOverBoth(cases, "shininess 10^4, local viewer", [](Scene& s) {
    addLight(s, {0.1, 0.05, 1}, 1e4);
    s.shading.localViewer = true;
  });
  addOverBoth(cases, "no light", [](Scene& s) { s.lights.clear(); });
  addOverBoth(cases, "no light, no ambient", [](Scene& s) {
    s.lights.clear();
    s.shading.ambient = 0;
  });
  addOverBoth(cases, "64 lights", [](Scene& s) {
    s.lights.clear();
    for (int n = 0; n < 64; ++n)
      s.lights.push_back({{std::cos(2.4 * n), std::sin(2.4 * n), 1 - (n + 0.5) / 32},
                          n % 2 ? Space::camera : Space::patient,
                          {n % 3 / 2.0, n % 4 / 3.0, n % 5 / 4.0},
                          0.06,
                          true});
  });
  addOverBoth(cases, "light of intensity 1e6", [](Scene& s) {
    addLight(s, {0.3, 0.2, 1});
    s.lights[0].intensity = 1e6;
  });
}

}  // namespace volumen::tests
