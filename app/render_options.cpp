#include "app/render_options.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "app/list_presets.h"
#include "app/option_words.h"
#include "app/usage.h"
#include "io/files/scene_file.h"
#include "results/pictures/own_presets.h"
#include "viewer/phantoms/phantoms.h"
#include "viewer/plan/rule_lines.h"
#include "viewer/scene/first_camera.h"
#include "viewer/scene/modes.h"
#include "viewer/scene/presets.h"
#include "viewer/scene/scene_json.h"

namespace volumen {

namespace {

OptionWords<Quality> namedQualities() {
  OptionWords<Quality> words;
  for (int n = 0; n < int(std::size(qualityLevels)); ++n)
    words.push_back({qualityLevels[n].name, Quality(n)});
  return words;
}
const OptionWords<Quality> qualities = namedQualities();
OptionWords<Mode> namedModes() {
  OptionWords<Mode> words;
  for (const ModeRow& row : modeRows()) words.emplace_back(row.name, row.mode);
  return words;
}
const OptionWords<Mode> modes = namedModes();
const OptionWords<Shader> shaders{
    {"auto", Shader::automatic}, {"phong", Shader::phong}, {"map", Shader::map}, {"table", Shader::table}};
const OptionWords<Method> methods{{"planes", Method::planes},
                                  {"blend", Method::blend},
                                  {"preshaded", Method::preshaded},
                                  {"gpu", Method::gpu},
                                  {"reference", Method::reference}};
const OptionWords<Blending> blendings{
    {"float", Blending::floats}, {"16", Blending::bits16}, {"8", Blending::bits8}};
const OptionWords<MapLookup> mapLookups{{"bilinear", MapLookup::bilinear}, {"nearest", MapLookup::nearest}};
const OptionWords<GradientOperator> gradientOperators{{"sobel", GradientOperator::sobel},
                                                      {"central", GradientOperator::central},
                                                      {"zucker-hummel", GradientOperator::zuckerHummel}};

std::string withProblems(std::string sentence, const OwnPresets& own) {
  for (const std::string& problem : own.problems) sentence += " " + problem;
  return sentence;
}

// Returns a preset of the program or of the user. If the name is unknown, the Error also lists invalid preset
// files.
Result<Scene> namedPreset(const std::string& name, const Volume& volume) {
  const OwnPresets own = ownPresets();
  auto scene = presetScene(name.empty() ? "auto" : name, volume, own.presets);
  if (scene || own.problems.empty()) return scene;
  return Error{withProblems(scene.message(), own)};
}

// Applies --view and --projection to the camera; without them the scene keeps its own.
void overrideCamera(Scene& scene, const SceneOptions& options, const Volume& volume, double aspect) {
  if (options.view.empty() && options.projection.empty()) return;
  const bool given = scene.camera.has_value();
  Camera camera = scene.camera.value_or(firstCamera(volume.geometry()));
  const Projection projection = options.projection.empty()         ? camera.projection
                                : options.projection == "parallel" ? Projection::parallel
                                                                   : Projection::perspective;
  if (!options.view.empty()) camera = *standardView(options.view);
  const bool changed = projection != camera.projection;
  camera.projection = projection;
  if (!given || !options.view.empty())
    camera = fitCamera(camera, volume.geometry(), aspect);
  else if (changed && projection == Projection::perspective)  // keeps the size of objects at the target
    camera.distance = camera.height / 2 / std::tan(glm::radians(camera.fov) / 2);
  else if (changed)
    camera.height = 2 * camera.distance * std::tan(glm::radians(camera.fov) / 2);
  scene.camera = camera;
}

}  // namespace

void addSceneOptions(CLI::App& app, SceneOptions& o) {
  CLI::Option* scene =
      app.add_option("--scene", o.sceneFile, "A scene file, or a PNG that volumen wrote")->type_name("FILE");
  app.add_option("--preset", o.preset, "A preset by name, your own too (default: auto)")
      ->type_name("NAME")
      ->excludes(scene);
  addListPresets(app);
  oneOf(app.add_option("--view", o.view, "Look from this side"), standardViewNames());
  oneOf(app.add_option("--projection", o.projection, "The camera's projection"), {"parallel", "perspective"});
  app.add_option("--size", o.size, "Picture size in pixels, WIDTHxHEIGHT (default: 512x512)")
      ->type_name("WxH");
  oneOf(app.add_option("--mode", o.mode, "3D (composite), or a projection"), keys(modes));
}

Result<std::optional<Scene>> readScene(const SceneOptions& options) {
  if (options.sceneFile.empty()) return std::optional<Scene>();
  const auto text = sceneText(options.sceneFile);
  if (!text) return text.error();
  auto scene = sceneFromJson(*text);
  if (!scene) return Error{options.sceneFile + ": " + scene.message()};
  return std::optional<Scene>(std::move(*scene));
}

Result<Scene> makeScene(const SceneOptions& options, const std::optional<Scene>& file, const Volume& volume) {
  auto scene = file ? Result<Scene>(*file) : namedPreset(options.preset, volume);
  if (!scene) return scene;
  const auto size = sizeOf(options.size);
  if (!size) return size.error();
  if (!options.mode.empty()) scene->mode = meaning(modes, options.mode);
  overrideCamera(*scene, options, volume, double(size->x) / size->y);
  return scene;
}

CLI::Option* addQuality(CLI::App& app, MethodOptions& o) {
  return oneOf(app.add_option("--quality", o.quality,
                              "Quality level, each of a promised accuracy (default: standard)"),
               keys(qualities));
}

void addMethodOptions(CLI::App& app, MethodOptions& o) {
  CLI::Option* quality = addQuality(app, o);
  CLI::Option* step = number(
      app.add_option("--step", o.step, "Plain steps of this many voxels instead of a level"), 1. / 1024, 64);
  step->type_name("VOXELS")->excludes(quality);
  app.add_flag("--reference", o.reference, "The true picture, in double precision (slow)")
      ->excludes(quality)
      ->excludes(step);
  oneOf(app.add_option("--method", o.method, "Rendering method (default: planes)"), keys(methods));
  oneOf(app.add_option("--resampler", o.resampler,
                       "Resample with the CPU or OpenGL (default: gl with --method gpu, else cpu)"),
        {"cpu", "gl"});
  oneOf(
      app.add_option("--blending", o.blending, "Bits of the frame buffer of --method blend (default: float)"),
      keys(blendings));
  oneOf(app.add_option("--precision", o.precision,
                       "Bits of stored density and gradients (8: planes and blend on the CPU alone)"),
        {"8", "16", "32"});
  oneOf(app.add_option("--shader", o.shader,
                       "Lighting directly (phong), by reflectance map, or by 5-bit table (for comparison)"),
        keys(shaders));
  wholeNumber(app.add_option("--map-size", o.mapSize, "n of the reflectance map's n x n faces"), 2, 1024);
  oneOf(app.add_option("--map-lookup", o.mapLookup, "How the reflectance map is read (default: bilinear)"),
        keys(mapLookups));
  number(app.add_option("--tolerance", o.tolerance,
                        "Largest error of a ray, as a share of white, instead of the level's (standard: " +
                            inDigits(levelOf(Quality::standard).rayBudget / 255, 3) + ")"),
         1e-6, 1)
      ->type_name("SHARE");
  number(app.add_option("--stop-at", o.stopAt,
                        "End a ray where less than this share of the light behind comes through"),
         0, 1);
  number(app.add_option("--opacity-threshold", o.opacityThreshold,
                        "Skip samples whose opacity over one step is below this"),
         0, 1);
  wholeNumber(app.add_option("--curve-table", o.curveTable,
                             "Colour and opacity from a table of N entries instead of the exact curve"),
              2, 65536);
  oneOf(app.add_option("--gradient", o.gradient, "Gradient operator (default: sobel)"),
        keys(gradientOperators));
  addThreads(app, o.threads);
  app.add_flag("--full", o.full, "Switch every optimisation off (same picture, slower)");
}

bool leavesLevelOpen(const MethodOptions& options) {
  return options.quality.empty() && !options.step && !options.reference && options.method != "reference";
}

void addThreads(CLI::App& app, std::optional<int>& threads) {
  wholeNumber(app.add_option("--threads", threads, "Number of threads (default: all cores)"), 1, 1024);
}

Result<RenderOptions> renderOptions(const SceneOptions& scene, const MethodOptions& method) {
  RenderOptions out;
  const auto size = sizeOf(scene.size);
  if (!size) return size.error();
  out.size = *size;
  if (!scene.preset.empty()) {
    const OwnPresets own = ownPresets();
    if (Status known = checkPreset(scene.preset, own.presets); !known)
      return Error{withProblems(known.message() + " (`volumen --list-presets` shows all)", own)};
  }
  if (!method.quality.empty()) out.quality = meaning(qualities, method.quality);
  out.step = method.step;
  out.method = method.reference ? Method::reference : meaning(methods, method.method);
  if (out.method == Method::reference && (method.step || !method.quality.empty()))
    return Error{"--method reference has no steps or levels; leave --step and --quality out."};
  if (!method.resampler.empty()) out.resampler = method.resampler == "gl" ? Resampler::gl : Resampler::cpu;
  if (!method.blending.empty()) out.blending = meaning(blendings, method.blending);
  out.shader = meaning(shaders, method.shader);
  out.precision = method.precision;
  out.mapSize = method.mapSize;
  if (!method.mapLookup.empty()) out.mapLookup = meaning(mapLookups, method.mapLookup);
  out.tolerance = method.tolerance;
  out.stopAt = method.stopAt;
  out.opacityThreshold = method.opacityThreshold;
  out.curveTable = method.curveTable;
  out.gradient = meaning(gradientOperators, method.gradient);
  out.threads = method.threads.value_or(0);
  out.full = method.full;
  return out;
}

Status checkPlan(const SceneOptions& options, const std::optional<Scene>& file, const RenderOptions& asked) {
  const Result<VolumePtr> standIn = makePhantom("sphere:16");
  if (!standIn) return standIn.error();
  const auto scene = makeScene(options, file, **standIn);
  if (!scene) return scene.error();
  VolumeFacts facts;
  facts.geometry = (*standIn)->geometry();
  const auto plan = makePlan(*scene, facts, asked);
  return plan ? Status() : Status(plan.error());
}

}  // namespace volumen
