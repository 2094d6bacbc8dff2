#include "tests/unit/render/method_cases.h"

#include <cmath>

#include "tests/fixtures/small_volumes.h"

namespace volumen::tests {

VolumePtr wavyVolume(glm::ivec3 size) {
  return volumeOf<std::int16_t>(
      size, glm::dmat3({0.8, 0.3, 0}, {-0.3, 0.9, 0.1}, {0.1, 0, 1.7}), [](glm::dvec3 x) {
        return 500 + 350 * (std::sin(0.41 * x.x + 0.3) + std::sin(0.37 * x.y) * std::cos(0.33 * x.z));
      });
}

Scene softScene(Projection projection) {
  Scene scene;
  scene.transferFunction = {
      1, {{150, {0.9, 0.5, 0.3}, 0}, {500, {0.9, 0.7, 0.4}, 0.1}, {1100, {1, 1, 0.9}, 0.8}}, {}};
  scene.camera = Camera{};
  scene.camera->direction = {-0.62, 0.7, -0.31};
  scene.camera->height = 36;
  scene.camera->distance = 60;
  scene.camera->projection = projection;
  return scene;
}

namespace {

void change(Scene& s, const std::string& what) {
  auto& points = s.transferFunction.points;
  if (what == "opaque") points.back().opacity = 1;
  if (what == "translucent") points = {{-200, {0.3, 0.5, 0.9}, 0.005}, {1200, {1, 0.8, 0.6}, 0.04}};
  if (what == "unlit") s.shading.lit = false;
  if (what == "clipped") {
    s.clip.boxLow = {0.2, 0.05, 0.3};
    s.clip.planes = {{{1, 2, -0.5}, 3}};
  }
  if (what == "sharp curve") points = {{600, {0.8, 0.3, 0.2}, 0}, {600, {0.9, 0.5, 0.2}, 0.6}};
  if (what != "many lights") return;
  s.lights.clear();
  // Their sum is at most 1, so that an 8-bit frame buffer clips nothing.
  for (int n = 0; n < 12; ++n)
    s.lights.push_back(
        {{std::cos(0.7 * n), std::sin(0.9 * n), 0.8}, Space::camera, {1, 0.9, 0.8}, 0.06, true});
}

}  // namespace

const std::vector<MethodScene>& methodScenes() {
  static const std::vector<MethodScene> scenes = [] {
    std::vector<MethodScene> all;
    for (Projection projection : {Projection::parallel, Projection::perspective})
      for (const char* what :
           {"opaque", "translucent", "lit", "unlit", "clipped", "sharp curve", "many lights"}) {
        const bool parallel = projection == Projection::parallel;
        all.push_back({std::string(parallel ? "parallel, " : "perspective, ") + what, softScene(projection)});
        change(all.back().scene, what);
      }
    return all;
  }();
  return scenes;
}

Result<Rendered> planAndDraw(RenderCaches& caches, const Scene& scene, const RenderOptions& options,
                             const CancelToken& cancel) {
  const auto plan = makePlan(scene, caches.facts(), options);
  if (!plan) return plan.error();
  return render(*plan, caches, cancel);
}

const std::vector<MethodCase>& methodCases() {
  static const std::vector<MethodCase> cases = [] {
    std::vector<MethodCase> all;
    const auto add = [&](const char* name, Method method, Resampler resampler) -> RenderOptions& {
      all.push_back({name, {}, resampler == Resampler::gl});
      RenderOptions& o = all.back().options;
      o.method = method;
      o.resampler = resampler;
      return o;
    };
    add("planes", Method::planes, Resampler::cpu);
    add("planes, OpenGL", Method::planes, Resampler::gl);
    add("blend", Method::blend, Resampler::cpu);
    add("blend, 16 bits", Method::blend, Resampler::cpu).blending = Blending::bits16;
    add("blend, 8 bits", Method::blend, Resampler::cpu).blending = Blending::bits8;
    add("blend, OpenGL", Method::blend, Resampler::gl);
    add("blend, OpenGL, 16 bits", Method::blend, Resampler::gl).blending = Blending::bits16;
    add("blend, OpenGL, 8 bits", Method::blend, Resampler::gl).blending = Blending::bits8;
    add("blend, OpenGL that filters", Method::blend, Resampler::gl).precision = 16;
    add("gpu", Method::gpu, Resampler::gl);
    add("gpu that filters", Method::gpu, Resampler::gl).precision = 16;
    add("preshaded", Method::preshaded, Resampler::cpu);
    add("preshaded, OpenGL", Method::preshaded, Resampler::gl);
    return all;
  }();
  return cases;
}

}  // namespace volumen::tests
