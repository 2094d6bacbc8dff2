#include <iostream>
#include <memory>
#include <set>

#include "app/command.h"
#include "app/commands/bench_paper.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "app/render_options.h"
#include "viewer/evaluation/orbit.h"

namespace volumen {

namespace {

struct BenchOptions {
  std::string path, series, folder;
  SceneOptions scene;
  MethodOptions method;
  OrbitOptions orbit;
  std::optional<double> elevation;
  bool json = false, paper = false;
};

// --elevation stands the camera above the plane that it turns in; a camera that the scene does not give is
// fitted there.
void raiseCamera(Scene& scene, const Volume& volume, glm::ivec2 size, double degrees) {
  const bool given = scene.camera.has_value();
  scene.camera = elevated(scene.camera.value_or(Camera{}), degrees);
  if (!given) scene.camera = fitCamera(*scene.camera, volume.geometry(), double(size.x) / size.y);
}

int run(const BenchOptions& options, const CancelToken& cancel) {
  if (options.paper && options.folder.empty())
    return failUsage("--paper writes several files: say into which folder with -o FOLDER.");
  if (options.paper)
    return benchPaper(options.folder, options.path,
                      {.rounds = options.orbit.rounds, .threads = options.method.threads.value_or(0)},
                      cancel);
  if (!options.folder.empty()) return failUsage("-o FOLDER goes with --paper; an orbit is told on stdout.");
  if (options.path.empty())
    return failUsage("Say what is drawn: PATH, a file, a folder or phantom:NAME[:SIZE].");
  const auto asked = renderOptions(options.scene, options.method);
  if (!asked) return failUsage(asked.message());
  auto opened = openVolume(options.path, options.series, cancel);
  if (!opened) return fail(opened.message());
  printNotes(opened->notes);
  const VolumePtr volume = opened->loaded.drawn;
  auto scene = makeScene(options.scene, *volume);
  if (!scene) return fail(scene.message());
  if (options.elevation) raiseCamera(*scene, *volume, asked->size, *options.elevation);
  RenderCaches caches(volume);
  if (Status s = checkPlan(*scene, *volume, *asked); !s) return failUsage(s.message());
  const auto orbit = measureOrbit(*scene, *asked, options.orbit, caches, terminalProgress(), cancel);
  endTerminalProgress();
  if (!orbit) return fail(cancel.cancelled() ? "Stopped; nothing was measured." : orbit.message());
  std::cout << (options.json ? orbitJson(*orbit) : orbitText(*orbit));
  return exitDone;
}

}  // namespace

std::function<int()> makeBench(CLI::App& app, const CancelToken& cancel) {
  auto o = std::make_shared<BenchOptions>();
  app.add_option(
      "PATH", o->path,
      "A file, a folder or phantom:NAME[:SIZE]; with --paper a folder of test data, for stand-ins of the "
      "paper's scans");
  auto* paper = app.add_flag(
      "--paper", o->paper,
      "Measure the paper's Tables 1 and 2, Figure 9 and section 4 on this machine (into the folder of -o)");
  app.add_option("-o,--output", o->folder, "The folder that --paper writes");
  app.add_option("--series", o->series, "Which series: its id, its UID or its number in `volumen info`");
  addSceneOptions(app, o->scene);
  addMethodOptions(app, o->method);
  app.add_option("--views", o->orbit.views,
                 "So many views, the camera turned about its up axis by 360/N each")
      ->check(CLI::Range(1, 3600))
      ->capture_default_str();
  app.add_option("--rounds", o->orbit.rounds, "Frames a view; every round draws each view once")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--elevation", o->elevation,
                 "Stand the camera so many degrees above the plane that it turns in, on the side of up")
      ->check(CLI::Range(-89.0, 89.0));
  app.add_flag("--json", o->json, "One JSON object on stdout");
  // The paper says what is drawn, and how.
  const std::set<std::string> goWithPaper{"PATH", "help", "output", "paper", "rounds", "threads"};
  for (CLI::Option* other : app.get_options())
    if (!goWithPaper.count(other->get_lnames().empty() ? other->get_name() : other->get_lnames().front()))
      paper->excludes(other);
  return [o, &cancel] { return run(*o, cancel); };
}

}  // namespace volumen
