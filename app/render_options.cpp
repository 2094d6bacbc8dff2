#include "app/render_options.h"

#include <cmath>
#include <fstream>
#include <glm/trigonometric.hpp>
#include <map>
#include <sstream>

#include "ui/session/own_presets.h"
#include "viewer/plan/plan.h"
#include "viewer/scene/first_camera.h"
#include "viewer/scene/presets.h"
#include "viewer/scene/scene_json.h"

namespace volumen {

namespace {

const std::map<std::string, Quality> qualities{{"draft", Quality::draft},
                                               {"standard", Quality::standard},
                                               {"high", Quality::high},
                                               {"exact", Quality::exact}};
const std::map<std::string, Mode> modes{
    {"composite", Mode::composite}, {"mip", Mode::mip}, {"minip", Mode::minip}, {"average", Mode::average}};
const std::map<std::string, Shader> shaders{
    {"auto", Shader::automatic}, {"map", Shader::map}, {"table", Shader::table}, {"phong", Shader::phong}};
const std::map<std::string, Method> methods{{"planes", Method::planes},
                                            {"blend", Method::blend},
                                            {"preshaded", Method::preshaded},
                                            {"gpu", Method::gpu},
                                            {"reference", Method::reference}};
const std::map<std::string, Blending> blendings{
    {"float", Blending::floats}, {"16", Blending::bits16}, {"8", Blending::bits8}};
const std::map<std::string, MapLookup> mapLookups{{"nearest", MapLookup::nearest},
                                                  {"bilinear", MapLookup::bilinear}};
const std::map<std::string, GradientOperator> gradientOperators{
    {"sobel", GradientOperator::sobel},
    {"central", GradientOperator::central},
    {"zucker-hummel", GradientOperator::zuckerHummel}};

template <class Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> out;
  for (const auto& entry : map) out.push_back(entry.first);
  return out;
}

Result<glm::ivec2> sizeOf(const std::string& text) {
  glm::ivec2 size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%6dx%6d%c", &size.x, &size.y, &rest) != 2 || size.x < 1 || size.y < 1)
    return Error{"--size must be WxH, like 512x512, not \"" + text + "\"."};
  return size;
}

Result<Scene> readScene(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{path + ": the scene file cannot be read."};
  std::ostringstream text;
  text << file.rdbuf();
  if (!file.eof() && file.fail()) return Error{path + ": the scene file cannot be read."};
  auto scene = sceneFromJson(text.str());
  if (!scene) return Error{path + ": " + scene.message()};
  return scene;
}

// A preset of the program's or the user's own; a file of theirs that is none is told where no name fits.
Result<Scene> namedPreset(const std::string& name, const Volume& volume) {
  const OwnPresets own = ownPresets();
  auto scene = presetScene(name.empty() ? "auto" : name, volume, own.presets);
  if (scene || own.problems.empty()) return scene;
  std::string sentence = scene.message();
  for (const std::string& problem : own.problems) sentence += " " + problem;
  return Error{sentence};
}

// The camera after --view and --projection; none where the scene's default holds.
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
  else if (changed && projection == Projection::perspective)  // what lies at the target keeps its size
    camera.distance = camera.height / 2 / std::tan(glm::radians(camera.fov) / 2);
  else if (changed)
    camera.height = 2 * camera.distance * std::tan(glm::radians(camera.fov) / 2);
  scene.camera = camera;
}

}  // namespace

void addSceneOptions(CLI::App& app, SceneOptions& o) {
  app.add_option("--scene", o.sceneFile, "A scene file (JSON)");
  app.add_option("--preset", o.preset, "A preset by name, your own too, or auto (the default)")
      ->excludes("--scene");
  app.add_option("--view", o.view, "Look from this side")->check(CLI::IsMember(standardViewNames()));
  app.add_option("--projection", o.projection, "Of the camera")
      ->check(CLI::IsMember({"parallel", "perspective"}));
  app.add_option("--size", o.size, "Of the picture, in pixels")->capture_default_str();
  app.add_option("--mode", o.mode, "What is drawn along each ray")->check(CLI::IsMember(keys(modes)));
}

Result<Scene> makeScene(const SceneOptions& options, const Volume& volume) {
  auto scene = options.sceneFile.empty() ? namedPreset(options.preset, volume) : readScene(options.sceneFile);
  if (!scene) return scene;
  const auto size = sizeOf(options.size);
  if (!size) return size.error();
  if (!options.mode.empty()) scene->mode = modes.at(options.mode);
  overrideCamera(*scene, options, volume, double(size->x) / size->y);
  return scene;
}

void addMethodOptions(CLI::App& app, MethodOptions& o) {
  auto* quality =
      app.add_option("--quality", o.quality, "Level, each with its error promise (default: standard)")
          ->check(CLI::IsMember(keys(qualities)));
  auto* step =
      app.add_option("--step", o.step, "Plain midpoint rule with this step in voxels, instead of a level")
          ->excludes(quality);
  app.add_flag("--reference", o.reference, "The true picture, in double precision (slow)")
      ->excludes(quality)
      ->excludes(step);
  app.add_option("--method", o.method, "How it is drawn")
      ->check(CLI::IsMember(keys(methods)))
      ->capture_default_str();
  app.add_option("--resampler", o.resampler, "What resamples (default: gl with --method gpu, else cpu)")
      ->check(CLI::IsMember({"cpu", "gl"}));
  app.add_option("--blending", o.blending, "Bits of the frame buffer of --method blend (default: float)")
      ->check(CLI::IsMember(keys(blendings)));
  app.add_option("--precision", o.precision,
                 "Bits of stored density and gradients (8: planes and blend on the CPU alone)")
      ->check(CLI::IsMember({8, 16, 32}));
  app.add_option("--shader", o.shader,
                 "How samples are lit: reflectance map, 5-bit table (for comparison) or directly")
      ->check(CLI::IsMember(keys(shaders)))
      ->capture_default_str();
  app.add_option("--map-size", o.mapSize, "n of the reflectance map's n x n faces")
      ->check(CLI::Range(2, 1024));
  app.add_option("--map-lookup", o.mapLookup, "How the reflectance map is read (default: bilinear)")
      ->check(CLI::IsMember(keys(mapLookups)));
  app.add_option(
         "--tolerance", o.tolerance,
         "What a ray may be off by, as a share of white, instead of what its level allows (standard: 0.0314)")
      ->check(CLI::Range(1e-6, 1.0));
  app.add_option("--stop-at", o.stopAt,
                 "End a ray where less than this share of the light behind comes through")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--opacity-threshold", o.opacityThreshold,
                 "Pass over samples whose opacity, over one step, is below this")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--curve-table", o.curveTable,
                 "Look colour and opacity up in a table of so many entries, instead of the exact curve")
      ->check(CLI::Range(2, 65536));
  app.add_option("--gradient", o.gradient, "How gradients are estimated")
      ->check(CLI::IsMember(keys(gradientOperators)))
      ->capture_default_str();
  app.add_option("--threads", o.threads, "How many (default: all allowed cores)")->check(CLI::Range(1, 1024));
  app.add_flag("--full", o.full,
               "Leave nothing out: every sound rule of the planner off, the same picture, slower");
}

Result<RenderOptions> renderOptions(const SceneOptions& scene, const MethodOptions& method) {
  RenderOptions out;
  const auto size = sizeOf(scene.size);
  if (!size) return size.error();
  out.size = *size;
  if (!method.quality.empty()) out.quality = qualities.at(method.quality);
  out.step = method.step;
  out.method = method.reference ? Method::reference : methods.at(method.method);
  if (out.method == Method::reference && (method.step || !method.quality.empty()))
    return Error{"--method reference has no steps or levels; leave --step and --quality out."};
  if (!method.resampler.empty()) out.resampler = method.resampler == "gl" ? Resampler::gl : Resampler::cpu;
  if (!method.blending.empty()) out.blending = blendings.at(method.blending);
  out.shader = shaders.at(method.shader);
  out.precision = method.precision;
  out.mapSize = method.mapSize;
  if (!method.mapLookup.empty()) out.mapLookup = mapLookups.at(method.mapLookup);
  out.tolerance = method.tolerance;
  out.stopAt = method.stopAt;
  out.opacityThreshold = method.opacityThreshold;
  out.curveTable = method.curveTable;
  out.gradient = gradientOperators.at(method.gradient);
  out.threads = method.threads.value_or(0);
  out.full = method.full;
  return out;
}

Status checkPlan(const Scene& scene, const Volume& volume, const RenderOptions& options) {
  VolumeFacts facts;
  facts.geometry = volume.geometry();
  const auto plan = makePlan(scene, facts, options);
  return plan ? Status() : Status(plan.error());
}

}  // namespace volumen
