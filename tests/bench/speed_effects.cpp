#include <glm/trigonometric.hpp>

#include "tests/bench/speed.h"
#include "tests/fixtures/cpu_targets.h"
#include "viewer/evaluation/statistics.h"

namespace volumen::bench {

namespace {

// A change of a scene or its options, and the rule that decides its effect.
struct Change {
  const char *name, *rule;
  void (*see)(Scene&);
  void (*draw)(RenderOptions&) = [](RenderOptions&) {};
};

void seePerspective(Scene& s) {
  s.camera->projection = Projection::perspective;
  // Keeps the size at the target that parallel projection gives.
  s.camera->distance = s.camera->height / 2 / std::tan(glm::radians(s.camera->fov) / 2);
}

void cutByThreePlanes(Scene& s) {
  const glm::dvec3 centre = *s.camera->target;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 normal(0);
    normal[axis] = 1;
    s.clip.planes.push_back({normal, centre[axis] + 40});
  }
}

// Makes all values from 200 up opaque and all below transparent.
void makeOpaque(Scene& s) {
  const CurvePoint most = s.transferFunction.points.back();
  s.transferFunction.points = {{200, most.colour, 0}, {200, most.colour, 1}};
}

const std::vector<Change>& changes() {
  static const std::vector<Change> all{
      {"as it is: parallel, lit", "empty blocks", [](Scene&) {}},
      {"perspective", "method", seePerspective},
      {"clip box, half of the volume", "clip", [](Scene& s) { s.clip.boxHigh.x = 0.5; }},
      {"three clip planes", "clip", cutByThreePlanes},
      {"1 light", "shader", [](Scene& s) { s.lights = ringOfLights(1); }},
      {"4 lights", "shader", [](Scene& s) { s.lights = ringOfLights(4); }},
      {"16 lights", "shader", [](Scene& s) { s.lights = ringOfLights(16); }},
      {"16 lights, `--shader map`", "shader", [](Scene& s) { s.lights = ringOfLights(16); },
       [](RenderOptions& o) { o.shader = Shader::map; }},
      {"specular 0", "specular", [](Scene& s) { s.shading.specular = 0; }},
      {"unlit", "gradients", [](Scene& s) { s.shading.lit = false; }},
      {"opaque above 200", "early ray termination", makeOpaque},
      {"gradient opacity", "gradient opacity",
       [](Scene& s) {
         s.transferFunction.gradientOpacity = {{20, 0}, {100, 1}};
       }},
      {"local viewer", "shader", [](Scene& s) { s.shading.localViewer = true; }},
      {"mode mip", "empty blocks", [](Scene& s) { s.mode = Mode::mip; }},
      {"mode average", "empty blocks", [](Scene& s) { s.mode = Mode::average; }},
      {"every sound rule off (`--full`)", "empty blocks", [](Scene&) {},
       [](RenderOptions& o) { o.full = true; }}};
  return all;
}

// Returns the rule's line of --explain up to its first colon, semicolon or comma.
std::string reasonOf(const Plan& plan, const std::string& rule) {
  for (const Effect& e : plan.effects)
    if (e.name == rule)
      return rule + (e.on ? " on: " : " off: ") + e.reason.substr(0, e.reason.find_first_of(":;,"));
  return {};
}

}  // namespace

Result<std::string> effectTable(const SpeedInputs& in, RenderCaches& caches) {
  const NamedScene& named = in.scenes.front();
  const auto whole = makePlan(named.scene, caches.facts(), plainSteps(in.threads));
  if (!whole) return whole.error();
  std::vector<Case> cases;
  for (const Change& change : changes()) {
    Case c{change.name, whole->scene, plainSteps(in.threads), &caches};
    change.see(c.scene);
    change.draw(c.options);
    cases.push_back(std::move(c));
  }
  for (int round = 0; round < in.rounds; ++round)
    if (Status s = drawRound(cases); !s) return s.error();
  std::string out = "| " + named.name + ", `--step 1` | ms | against it as it is | what the rule says |\n" +
                    "|---|---|---|---|\n";
  for (std::size_t n = 0; n < cases.size(); ++n)
    out += text("| %s | %.0f | %.2f x | %s |\n", cases[n].name.c_str(), msOf(cases[n]),
                msOf(cases[n]) / msOf(cases[0]), reasonOf(cases[n].plan, changes()[n].rule).c_str());
  return out;
}

Result<std::string> targetTable(const SpeedInputs& in, RenderCaches& caches) {
  struct Target {
    std::string name;
    std::vector<Case> cases;
  };
  std::vector<Target> targets;
  Status failed;
  for (int round = 0; round < in.rounds; ++round)
    tests::onEveryCpuTarget([&] {
      const std::string name = kernelTarget();
      if (name != "AVX2" && name != "SSE4" && name != "AVX3") return;
      Target* target = nullptr;
      for (Target& t : targets)
        if (t.name == name) target = &t;
      if (!target) {
        target = &targets.emplace_back(Target{name, {}});
        for (const NamedScene& s : in.scenes)
          target->cases.push_back({s.name, s.scene, plainSteps(in.threads), &caches});
      }
      if (Status s = drawRound(target->cases); !s) failed = s;
    });
  if (!failed) return failed.error();
  std::string out = "| ms, `--step 1` |", line = "\n|---|";
  for (const Target& t : targets) {
    out += " " + (t.name == "AVX3" ? "AVX-512" : t.name) + " |";
    line += "---|";
  }
  out += line + "\n";
  for (std::size_t n = 0; n < in.scenes.size(); ++n) {
    out += "| " + in.scenes[n].name + " |";
    for (const Target& t : targets)
      out += text(" %.0f (%.2f x) |", msOf(t.cases[n]), msOf(t.cases[n]) / msOf(targets.front().cases[n]));
    out += "\n";
  }
  return out;
}

}  // namespace volumen::bench
