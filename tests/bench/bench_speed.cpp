// Measures all speeds that need no other program for comparison. usage: bench_speed PATH SCENE.json...
// [--rounds N] [--threads N]. PATH should be a chest CT. Effects are measured one by one on the first scene.
// Prints Markdown tables of goals, costs of effects and instruction sets. Frame times are medians over an
// 8-view orbit, each view at its fastest of N interleaved rounds. Asserts nothing.
#include <cstdio>
#include <ctime>

#include "tests/bench/speed.h"
#include "viewer/evaluation/accuracy_study.h"

namespace {

using namespace volumen;
using namespace volumen::bench;

Result<SpeedInputs> readInputs(int argc, char** argv) {
  const auto arguments = readArguments(argc, argv, false);
  if (!arguments) return arguments.error();
  SpeedInputs in;
  in.rounds = arguments->rounds;
  in.threads = arguments->threads;
  for (const std::string& path : arguments->scenes) {
    auto scene = readScene(path);
    if (!scene) return scene.error();
    in.scenes.push_back(std::move(*scene));
  }
  auto volume = readVolume(arguments->path);
  if (!volume) return volume.error();
  in.volume = std::move(*volume);
  return in;
}

void printHead(const SpeedInputs& in) {
  char date[64];
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof date, "%d %B %Y", std::localtime(&now));
  const glm::ivec3 n = in.volume->size();
  std::printf("%s, %s; %d x %d x %d voxels, fastest of %d rounds, median over 8 views.\n",
              machineName().c_str(), date, n.x, n.y, n.z, in.rounds);
}

void print(const std::vector<Goal>& goals) {
  for (const Goal& g : goals)
    std::printf("| %s | %s | %s | %s |\n", g.what.c_str(), g.measured.c_str(), g.goal.c_str(),
                g.goal.empty() ? ""
                : g.reached    ? "yes"
                               : "no");
  std::fflush(stdout);
}

Status run(const SpeedInputs& in) {
  printHead(in);
  RenderCaches caches(in.volume);
  std::printf("\n| what | measured | goal | reached |\n|---|---|---|---|\n");
  const auto goals = measureGoals(in, caches);
  if (!goals) return goals.error();
  print(*goals);
  const auto large = measureLargeVolume(in);
  if (!large) return large.error();
  print(*large);
  for (const auto table : {effectTable, targetTable}) {
    const auto made = table(in, caches);
    if (!made) return made.error();
    std::printf("\n%s", made->c_str());
    std::fflush(stdout);
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  const auto in = readInputs(argc, argv);
  const Status done = in ? run(*in) : Status(in.error());
  if (!done) std::fprintf(stderr, "%s\n", done.message().c_str());
  return done ? 0 : 1;
}
