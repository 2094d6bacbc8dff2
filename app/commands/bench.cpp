#include <iostream>
#include <memory>
#include <set>

#include "app/command.h"
#include "app/commands/bench_paper.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "app/render_options.h"
#include "app/usage.h"
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

// --elevation raises the camera above the plane in which it turns. A camera that the scene lacks is fitted
// there.
void raiseCamera(Scene& scene, const Volume& volume, glm::ivec2 size, double degrees) {
  const bool given = scene.camera.has_value();
  scene.camera = elevated(scene.camera.value_or(Camera{}), degrees);
  if (!given) scene.camera = fitCamera(*scene.camera, volume.geometry(), double(size.x) / size.y);
}

int run(const BenchOptions& options, const CancelToken& cancel) {
  if (options.paper && options.folder.empty())
    return failUsage("Missing output folder: use --paper -o FOLDER.");
  if (options.paper)
    return benchPaper(options.folder, options.path,
                      {.rounds = options.orbit.rounds, .threads = options.method.threads.value_or(0)},
                      cancel);
  if (!options.folder.empty())
    return failUsage("-o FOLDER goes with --paper alone; other results are written to stdout.");
  if (options.path.empty())
    return failUsage("Missing PATH: a file, a folder, index:STUDY[/SERIES], archive:NAME/STUDY[/SERIES] or phantom:NAME[:SIZE].");
  const auto asked = renderOptions(options.scene, options.method);
  if (!asked) return failUsage(asked.message());
  const auto file = readScene(options.scene);
  if (!file) return fail(file.message());
  if (Status s = checkPlan(options.scene, *file, *asked); !s) return failUsage(s.message());
  auto opened = openVolume(options.path, options.series, cancel);
  if (!opened) return fail(opened.message(), cancel);
  printNotes(opened->notes);
  const VolumePtr volume = opened->loaded.drawn;
  auto scene = makeScene(options.scene, *file, *volume);
  if (!scene) return fail(scene.message());
  if (options.elevation) raiseCamera(*scene, *volume, asked->size, *options.elevation);
  RenderCaches caches(volume);
  const auto orbit = measureOrbit(*scene, *asked, options.orbit, caches, terminalProgress(), cancel);
  endTerminalProgress();
  if (!orbit) return fail(orbit.message(), cancel);
  std::cout << (options.json ? printableJson(orbitJson(*orbit)) : orbitText(*orbit));
  return opened->status();
}

}  // namespace

std::function<int()> makeBench(CLI::App& app, const CancelToken& cancel) {
  auto o = std::make_shared<BenchOptions>();
  addPath(app, o->path)
      ->description("A file, a folder or phantom:NAME[:SIZE]; with --paper a folder of test data (optional)");
  auto* paper = app.add_flag(
      "--paper", o->paper,
      "Measure the paper's Tables 1 and 2, Figure 9 and section 4 on this machine (into the folder of -o)");
  app.add_option("-o,--output", o->folder, "The folder that --paper writes")->type_name("FOLDER");
  addSeries(app, o->series);
  addSceneOptions(app, o->scene);
  addMethodOptions(app, o->method);
  wholeNumber(app.add_option("--views", o->orbit.views, "Number of views of a full turn (default: 8)"), 1,
              3600);
  wholeNumber(app.add_option("--rounds", o->orbit.rounds, "Number of frames of each view (default: 5)"), 1,
              10000);
  number(app.add_option("--elevation", o->elevation, "Camera angle above the plane it turns in, in degrees"),
         -89, 89);
  app.add_flag("--json", o->json, "Write one JSON object to stdout");
  addExamples(app, {"volumen bench scans/ --views 8", "volumen bench scans/ --scene scene.json --json"});
  // The paper fixes the scenes and the method.
  const std::set<std::string> goWithPaper{"PATH",  "help",   "list-presets", "output",
                                          "paper", "rounds", "threads"};
  for (CLI::Option* other : app.get_options())
    if (!goWithPaper.count(other->get_lnames().empty() ? other->get_name() : other->get_lnames().front()))
      paper->excludes(other);
  return [o, &cancel] { return run(*o, cancel); };
}

}  // namespace volumen
