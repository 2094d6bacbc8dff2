// Measures the cost of accuracy. usage: bench_levels PATH SCENE.json [EDGE]. Prints a Markdown table of
// errors and frame times for plain steps and quality levels of a 512 x 512 picture. Errors (/255) are against
// the reference (design.md 2) at the well-conditioned ones of EDGE x EDGE of its pixels (default 192). Times
// are medians of 7 interleaved runs.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "io/load.h"
#include "io/open.h"
#include "io/study/choose.h"
#include "viewer/evaluation/truth.h"
#include "viewer/plan/rule_lines.h"
#include "viewer/render/render.h"
#include "viewer/scene/scene_json.h"
#include "viewer/volume/clock.h"

namespace {

using namespace volumen;

struct Row {
  const char* name;
  std::optional<double> step;
  Quality quality;
};

constexpr Row atLevel(Quality quality) { return {qualityName(quality), {}, quality}; }
constexpr Row rows[] = {{"step 1", 1, {}},          {"step 0.5", 0.5, {}},  atLevel(Quality::draft),
                        atLevel(Quality::standard), atLevel(Quality::high), atLevel(Quality::exact)};

RenderOptions optionsOf(const Row& row) {
  RenderOptions o;
  o.step = row.step;
  o.quality = row.quality;
  return o;
}

// Returns the time goal of a level. Empty for the draft, whose time is as requested.
std::string goalOf(const Row& row) {
  const double goal = row.step ? 0 : levelOf(row.quality).timeGoal;
  return goal > 0 ? inDigits(goal) + " x" : "";
}

double frameMs(const Plan& plan, RenderCaches& caches) {
  const double begin = wallMs();
  if (!render(plan, caches)) return 0;
  return wallMs() - begin;
}

int fail(const std::string& sentence) {
  std::fprintf(stderr, "%s\n", sentence.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return fail("usage: bench_levels PATH SCENE.json [EDGE]");
  const int edge = argc > 3 ? std::atoi(argv[3]) : 192;
  const auto study = openStudy(argv[1]);
  if (!study || study->volumes.empty()) return fail("no volume");
  const auto loaded = loadSeries(study->volumes[*chooseSeries(*study, {})]);
  if (!loaded) return fail(loaded.message());
  std::stringstream text;
  text << std::ifstream(argv[2]).rdbuf();
  const auto scene = sceneFromJson(text.str());
  if (!scene) return fail(scene.message());

  RenderCaches caches(loaded->drawn);
  std::vector<Plan> plans;
  for (const Row& row : rows) plans.push_back(*makePlan(*scene, caches.facts(), optionsOf(row)));
  const auto truth = makeTruth(plans[0].scene, *loaded->drawn, plans[0].options.size, edge * edge, 0);
  std::vector<std::vector<double>> times(plans.size());
  for (int run = 0; run < 8; ++run)
    for (std::size_t n = 0; n < plans.size(); ++n) {
      const double ms = frameMs(plans[n], caches);
      if (run > 0) times[n].push_back(ms);  // the first run makes gradients and warms up
    }
  std::printf(
      "| | maximum | 99th percentile | PSNR dB | ms a frame | against step 1 | goal |\n"
      "|---|---|---|---|---|---|---|\n");
  double plain = 0;
  for (std::size_t n = 0; n < plans.size(); ++n) {
    const Picture seen = atPixelsOf(*truth, render(plans[n], caches)->picture);
    const PictureError e = compare(seen, truth->picture, truth->well);
    std::sort(times[n].begin(), times[n].end());
    const double ms = times[n][times[n].size() / 2];
    if (n == 0) plain = ms;
    std::printf("| %s | %.2f | %.2f | %.1f | %.0f | %.2f x | %s |\n", rows[n].name, e.maximum, e.percentile99,
                e.psnrDb, ms, ms / plain, goalOf(rows[n]).c_str());
    std::fflush(stdout);
  }
  return 0;
}
