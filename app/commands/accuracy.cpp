#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/command.h"
#include "app/open_volume.h"
#include "app/progress.h"
#include "app/render_options.h"
#include "app/report_files.h"
#include "app/usage.h"
#include "results/plots/study_charts.h"
#include "viewer/evaluation/accuracy_study.h"

namespace volumen {

namespace {

struct AccuracyOptions {
  std::string path, series, folder;
  SceneOptions scene;
  std::vector<std::string> knobs;
  std::optional<int> threads;
  StudyOptions study;
};

Result<std::vector<Setting>> settingsOf(const AccuracyOptions& options, const RenderOptions& base) {
  std::vector<Setting> all = oneKnobAtATime(base);
  for (Setting& s : gridOfKnobs(base)) all.push_back(std::move(s));
  if (options.knobs.empty()) return all;
  std::string names;
  for (const Setting& s : all)
    if (names.find(s.knob) == std::string::npos) names += (names.empty() ? "\"" : ", \"") + s.knob + "\"";
  std::vector<Setting> chosen{all.front()};
  for (const std::string& knob : options.knobs) {
    const std::size_t before = chosen.size();
    std::copy_if(all.begin() + 1, all.end(), std::back_inserter(chosen),
                 [&](const Setting& s) { return s.knob == knob; });
    if (chosen.size() == before) return Error{"--knob: \"" + knob + "\" is not one of " + names + "."};
  }
  return chosen;
}

std::string sceneName(const SceneOptions& scene) {
  if (!scene.sceneFile.empty()) return std::filesystem::path(scene.sceneFile).stem().string();
  return "preset " + (scene.preset.empty() ? std::string("auto") : scene.preset);
}

Status writeAll(const AccuracyStudy& study, const StudyTitle& title, const std::string& folder) {
  if (Status s = makeFolder(folder); !s) return s;
  prepareFonts();
  if (Status s = writeReport(folder, "study.csv", studyCsv(study)); !s) return s;
  if (Status s = writeReport(folder, "study.json", studyJson(study, title)); !s) return s;
  const QImage plot = chartImage(errorAgainstTime(study, title), {1500, 960});
  if (Status s = writeReport(folder, "error-time.png", plot); !s) return s;
  if (Status s = writeReport(folder, "knobs.png", knobPanels(study, title)); !s) return s;
  return writeReport(folder, "differences.png", contactSheet(study, title));
}

std::vector<std::string> leftOutNote(const std::vector<std::string>& leftOut) {
  if (leftOut.size() < 2) return leftOut;
  return {std::to_string(leftOut.size()) +
          " settings cannot be drawn here and are left out (study.json names each); the first: " +
          leftOut.front()};
}

int run(const AccuracyOptions& options, const CancelToken& cancel) {
  MethodOptions method;
  method.threads = options.threads;
  const auto asked = renderOptions(options.scene, method);
  if (!asked) return failUsage(asked.message());
  const auto settings = settingsOf(options, studyBase(asked->size, asked->threads));
  if (!settings) return failUsage(settings.message());
  const auto file = readScene(options.scene);
  if (!file) return fail(file.message());
  if (Status s = checkPlan(options.scene, *file, settings->front().options); !s)
    return failUsage(s.message());
  if (Status s = checkFolder(options.folder); !s) return fail(s.message());
  auto opened = openVolume(options.path, options.series, cancel);
  if (!opened) return fail(opened.message(), cancel);
  printNotes(opened->notes);
  const VolumePtr volume = opened->loaded.drawn;
  const auto scene = makeScene(options.scene, *file, *volume);
  if (!scene) return fail(scene.message());
  RenderCaches caches(volume);
  const auto study = measure(*scene, *settings, options.study, caches, terminalProgress(), cancel);
  endTerminalProgress();
  if (!study) return fail(study.message(), cancel);
  printNotes(leftOutNote(study->leftOut));
  const std::string name = volume->attributes().name.empty() ? opened->series.id : volume->attributes().name;
  const Status written = writeAll(*study, titleOf(name, sceneName(options.scene)), options.folder);
  return written.ok() ? opened->status() : fail(written.message());
}

}  // namespace

std::function<int()> makeAccuracy(CLI::App& app, const CancelToken& cancel) {
  auto o = std::make_shared<AccuracyOptions>();
  addPath(app, o->path)->required();
  app.add_option("-o,--output", o->folder,
                 "The folder to write: study.csv, study.json, error-time.png, knobs.png, differences.png")
      ->type_name("FOLDER")
      ->required();
  addSeries(app, o->series);
  addSceneOptions(app, o->scene);
  app.add_option("--knob", o->knobs,
                 "Measure this setting alone (again for more; default: all, and the grid)")
      ->type_name("NAME")
      ->take_all();
  wholeNumber(app.add_option("--frames", o->study.frames, "Frames a row; slow rows get fewer (default: 5)"),
              1, 1000);
  wholeNumber(
      app.add_option("--pixels", o->study.mostPixels,
                     "Most pixels of the reference; of a larger picture it is computed at one in each "
                     "cell of a grid"),
      1, 1 << 26);
  addThreads(app, o->threads);
  addExamples(app, {"volumen accuracy scans/ --preset CT-Bone -o accuracy/",
                    "volumen accuracy scans/ --knob step --frames 1 --size 64x64 -o accuracy/"});
  return [o, &cancel] { return run(*o, cancel); };
}

}  // namespace volumen
