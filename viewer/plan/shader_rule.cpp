#include <algorithm>
#include <cstdio>

#include "viewer/plan/cost_model.h"
#include "viewer/plan/rule_lines.h"

namespace volumen {

std::string inDigits(double x, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, x);
  return text;
}

namespace {

bool shines(const Light& l) {
  return l.on && l.intensity > 0 && (l.colour.r > 0 || l.colour.g > 0 || l.colour.b > 0);
}

}  // namespace

int lightsThatShine(const Scene& scene) {
  return int(std::count_if(scene.lights.begin(), scene.lights.end(), shines));
}

bool lightIsColoured(const Scene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light& l) { return shines(l) && l.colour != glm::dvec3(l.colour.r); });
}

double brightest(const Scene& scene) {
  if (!scene.shading.lit) return 1;
  glm::dvec3 light(0);
  for (const Light& l : scene.lights)
    if (l.on) light += l.intensity * l.colour;
  const Shading& s = scene.shading;
  return s.ambient + (s.diffuse + s.specular) * std::max({light.r, light.g, light.b});
}

namespace {

std::string mapText(const Plan& plan) {
  const std::string n = std::to_string(plan.mapSize);
  // The corner of a patch is sqrt(2) / n from its middle, as seen from the cube's centre.
  return "reflectance map of " + n + " x " + n + " a face, " +
         (plan.mapLookup == MapLookup::nearest
              ? "nearest, as asked: directions off by up to " + inDigits(81.0 / plan.mapSize) + " degrees"
              : "bilinear, as asked");
}

}  // namespace

Effect decideShader(const RuleInput& in, Plan& plan) {
  plan.shader = Shader::phong;
  plan.mapSize = in.options.mapSize.value_or(128);
  plan.mapLookup = in.options.mapLookup.value_or(MapLookup::bilinear);
  if (!plan.lit) return off("nothing is lit");
  if (!in.scene.shading.lit) return on("direct: asked for in full, with the light of an unlit scene");
  const Shading& s = in.scene.shading;
  const int lights = lightsThatShine(in.scene);
  if (in.options.shader == Shader::table) {
    plan.shader = Shader::table;
    return on("table of 32 densities and 31 steps of each gradient component in 8 bits, as asked: bands");
  }
  if (in.options.shader == Shader::map || in.options.mapSize || in.options.mapLookup) {
    plan.shader = Shader::map;
    return on(mapText(plan));
  }
  if (in.options.shader == Shader::phong) return on("direct, as asked");
  if (s.localViewer) return on("direct: the viewer's direction changes from ray to ray");
  if (s.shininess > 200)
    return on("direct: a shininess of " + inDigits(s.shininess) + " is too sharp for a map");
  if (in.options.step || in.options.quality == Quality::exact)
    return on("direct: the exact light is asked for");
  if (lights == 0) return on("direct: no light shines");
  const double direct = predictedCost(plan, in.facts, Shader::phong).lightNs;
  const double map = predictedCost(plan, in.facts, Shader::map).lightNs;
  const std::string count = std::to_string(lights) + (lights == 1 ? " light" : " lights");
  if (direct <= map)
    return on("direct: light from " + count + " at a predicted " + inDigits(direct / map, 2) +
              " of what a reflectance map takes");
  plan.shader = Shader::map;
  return on("reflectance map: light from " + count + " at a predicted " + inDigits(map / direct, 2) +
            " of what direct light takes");
}

}  // namespace volumen
