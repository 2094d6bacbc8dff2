// Checks whether the planner chooses the fastest way. usage: bench_choices [PATH] [ROUNDS]. Draws a matrix of
// scenes of the volume (default phantom:ct-head:128) with each alternative of shader, method and resampler in
// turn. These frames are interleaved, ROUNDS times (default 5) after one warm-up. Prints a Markdown table of
// predicted ratios and ratios of medians, and how many choices were the faster one or within 10 % of it.
#include <algorithm>
#include <cstdio>

#include "tests/bench/cases.h"
#include "tests/bench/inputs.h"
#include "viewer/evaluation/statistics.h"
#include "viewer/methods/caches.h"
#include "viewer/plan/cost_model.h"
#include "viewer/volume/clock.h"

namespace {

using namespace volumen;
using namespace volumen::bench;

struct NamedQuestion {
  std::string name;
  Scene scene;
  RenderOptions chosen, other;
  std::string chosenName, otherName;
};

// Returns a scene of opaque bone, or of everything from soft tissue up, faint. It is unlit without lights.
Scene sceneOf(bool opaque, int lights, double shininess) {
  Scene scene;
  if (!opaque) scene.transferFunction.points = {{-200, {0.8, 0.5, 0.4}, 0}, {400, {1, 1, 0.9}, 0.02}};
  scene.shading.lit = lights > 0;
  scene.shading.shininess = shininess;
  scene.lights = ringOfLights(lights);
  return scene;
}

std::string nameOf(int edge, bool opaque, int lights, double shininess) {
  const std::string light = lights == 0 ? "unlit" : text("%d lights, shininess %g", lights, shininess);
  return text("%d x %d, %s, %s", edge, edge, opaque ? "opaque" : "translucent", light.c_str());
}

// Adds the question about the shader, map or direct: requests the one that was not chosen.
void askOfShader(std::vector<NamedQuestion>& out, const VolumeFacts& facts, const NamedQuestion& q) {
  const bool map = makePlan(q.scene, facts, q.chosen)->shader == Shader::map;
  NamedQuestion shader = q;
  shader.other.shader = map ? Shader::phong : Shader::map;
  shader.chosenName = map ? "map" : "direct";
  shader.otherName = map ? "direct" : "map";
  out.push_back(std::move(shader));
}

void askOfMethod(std::vector<NamedQuestion>& out, const NamedQuestion& q) {
  NamedQuestion method = q;
  method.chosenName = "planes";
  method.otherName = "blend";
  method.other.method = Method::blend;
  out.push_back(method);
  method.otherName = "planes by OpenGL";
  method.other.method = Method::planes;
  method.other.resampler = Resampler::gl;
  out.push_back(std::move(method));
}

std::vector<NamedQuestion> matrix(const VolumeFacts& facts) {
  std::vector<NamedQuestion> out;
  for (int edge : {96, 384})
    for (bool opaque : {true, false})
      for (int lights : {0, 1, 2, 3, 4, 8, 16}) {
        NamedQuestion q{nameOf(edge, opaque, lights, 20), sceneOf(opaque, lights, 20), {}, {}, {}, {}};
        q.chosen.size = q.other.size = {edge, edge};
        if (lights > 0) askOfShader(out, facts, q);
        if (lights <= 1) askOfMethod(out, q);
        if (lights < 4) continue;
        q.name = nameOf(edge, opaque, lights, 20.5);
        q.scene.shading.shininess = 20.5;
        askOfShader(out, facts, q);
      }
  return out;
}

double frameMs(const Plan& plan, RenderCaches& caches) {
  const double begin = wallMs();
  if (!render(plan, caches)) return 0;
  return wallMs() - begin;
}

struct Answer {
  double predicted = 0, measured = 0;  ///< ratios of the chosen way to the other
};

Answer answer(const NamedQuestion& q, RenderCaches& caches, int rounds) {
  RenderStats stats;
  const auto planOf = [&](const RenderOptions& options) {
    return *completedPlan(*makePlan(q.scene, caches.facts(), options), caches, stats);
  };
  const Plan plans[] = {planOf(q.chosen), planOf(q.other)};
  std::vector<double> ms[2];
  for (int round = 0; round <= rounds; ++round)
    for (int n = 0; n < 2; ++n) {
      if (plans[n].shader == Shader::map) caches.impl().map.reset();  // making the map belongs to the frame
      const double once = frameMs(plans[n], caches);
      if (round > 0) ms[n].push_back(once);
    }
  return {predictedCost(plans[0], caches.facts()).ns() / predictedCost(plans[1], caches.facts()).ns(),
          median(ms[0]) / median(ms[1])};
}

}  // namespace

int main(int argc, char** argv) {
  const auto volume = readVolume(argc > 1 ? argv[1] : "phantom:ct-head:128");
  if (!volume) {
    std::fprintf(stderr, "%s\n", volume.message().c_str());
    return 1;
  }
  const int rounds = argc > 2 ? std::max(1, std::atoi(argv[2])) : 5;
  RenderCaches caches(*volume);
  int good = 0, all = 0;
  std::printf(
      "| scene | chosen | against | predicted ratio | measured ratio | faster or within 10 %% |\n"
      "|---|---|---|---|---|---|\n");
  for (const NamedQuestion& q : matrix(caches.facts())) {
    const Answer a = answer(q, caches, rounds);
    const bool right = a.measured <= 1.1;
    good += right;
    ++all;
    std::printf("| %s | %s | %s | %.2f | %.2f | %s |\n", q.name.c_str(), q.chosenName.c_str(),
                q.otherName.c_str(), a.predicted, a.measured, right ? "yes" : "no");
    std::fflush(stdout);
  }
  std::printf("\n%d of %d choices were the faster one or within 10 %% of it.\n", good, all);
  return 0;
}
