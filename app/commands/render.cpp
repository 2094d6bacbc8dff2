#include <QImage>
#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/output_names.h"
#include "app/picture_output.h"
#include "app/scene_to_draw.h"
#include "app/usage.h"
#include "io/files/output_file.h"
#include "viewer/plan/picture_text.h"
#include "viewer/render/effect_costs.h"
#include "viewer/render/render.h"
#include "viewer/scene/scene_json.h"
#include "viewer/volume/clock.h"

namespace volumen {

namespace {

struct RenderArguments {
  DrawnOptions drawn;
  std::string output, statsFile, errorMap;
  int frames = 1, turntable = 0;
  bool noWarningLine = false, explain = false, printScene = false;
};

// Times that the command measures itself.
struct Times {
  double loadMs = 0, planMs = 0, gradientsMs = 0, totalMs = 0;
  std::vector<double> framesMs;
};

nlohmann::ordered_json pictureJson(const PictureText& text) {
  nlohmann::ordered_json out;
  for (const auto& [key, value] : text) out[key] = value;
  return out;
}

// Returns the estimated error of the picture in 1/255; psnrDb is null for no error. Null if there is no
// estimate.
nlohmann::ordered_json errorJson(const Rendered& done) {
  const auto estimated = estimateOf(done.plan, done.error);
  if (!estimated) return nullptr;
  nlohmann::ordered_json out{{"maximum", estimated->maximum},
                             {"percentile99", estimated->percentile99},
                             {"psnrDb", estimated->psnrDb}};
  if (const std::string without = notEstimated(done.plan); !without.empty()) out["without"] = without;
  return out;
}

nlohmann::ordered_json statsJson(const Rendered& done, const SceneToDraw& drawn, const Times& t) {
  const Plan& plan = done.plan;
  const RenderStats& s = done.stats;
  nlohmann::ordered_json out{{"stagesMs",
                              {{"load", t.loadMs},
                               {"gradients", t.gradientsMs},
                               {"plan", t.planMs},
                               {"pilot", s.pilotMs},
                               {"resample", s.resampleMs},
                               {"shade", s.shadeMs},
                               {"surfaces", s.surfacesMs},
                               {"gl", s.glMs},
                               {"total", t.totalMs}}},
                             {"framesMs", t.framesMs},
                             {"samples",
                              {{"resampled", s.resampled},
                               {"shaded", s.shaded},
                               {"composited", s.composited},
                               {"redoneRays", s.redone}}},
                             {"bytes",
                              {{"volume", drawn.volume().bytes()},
                               {"density", s.densityBytes},
                               {"gradients", s.gradientBytes},
                               {"blocks", s.blockBytes},
                               {"tables", s.tableBytes}}},
                             {"threads", s.threads},
                             {"kernel", s.kernel},
                             {"step", plan.stepVoxels},
                             {"precision", plan.bits},
                             {"error", errorJson(done)}};
  if (done.error.empty()) out["errorUnknown"] = whyNoEstimate(plan);
  out["plan"] = nlohmann::ordered_json::parse(explainJson(plan, effectCosts(plan, s)));
  out["picture"] = pictureJson(drawn.textOf(done));
  out["reducedBy"] = drawn.reducedBy();
  out["warnings"] = sentences(drawn.warnings);
  out["unread"] = unreadJson(drawn.unread);
  return out;
}

Status writePicture(const Rendered& done, const PictureText& text, const std::vector<Warning>& warnings,
                    bool warningLine, const std::string& path) {
  if (isFloatPicture(path)) return writePictureNrrd(done.picture, path);
  return writePictureWithWarnings(imageForFile(done.picture), text, warnings, warningLine, path);
}

class Run {
 public:
  Run(const RenderArguments& options, const CancelToken& cancel) : options_(options), cancel_(cancel) {}

  int operator()() {
    const double begin = wallMs();
    if (const int wrong = checkUsage()) return wrong;
    const DrawnOptions& how = options_.drawn;
    auto render = renderOptions(how.scene, how.method);
    if (!render) return failUsage(render.message());
    render->withError = !options_.errorMap.empty();
    const auto asked = readAskedScene(how, *render, cancel_);
    if (!asked) return fail(asked.message(), cancel_);
    if (Status s = checkPlan(how.scene, asked->scene, asked->options); !s) return failUsage(s.message());
    if (Status s = checkOutputs(); !s) return fail(s.message());
    auto drawn = SceneToDraw::load(how, *asked, cancel_);
    if (!drawn) return fail(drawn.message(), cancel_);
    if (Status s = checkApart(outputs(options_.turntable), drawn->series.files); !s) return fail(s.message());
    times_.loadMs = wallMs() - begin;
    const Status fits = drawn->fitToMemory(how.path, asked->options);
    printNotes(drawn->notes);
    if (!fits) return fail(fits.message());
    const int status = draw(*drawn, asked->options);
    times_.totalMs = wallMs() - begin;
    return status == exitDone ? finish(*drawn) : status;
  }

 private:
  int checkUsage() const {
    const bool quiet = options_.explain || options_.printScene || !options_.statsFile.empty();
    if (options_.output.empty() && !quiet)
      return failUsage("Missing output file: use -o PICTURE (.png or .nrrd).");
    if (const std::string said = saidBySession(options_.drawn); !said.empty())
      return failUsage(options_.drawn.path + " is a session, which says what is drawn: leave " + said +
                       " out.");
    if (options_.output.empty()) return 0;
    const Status named = checkPictureName(options_.output);
    return named ? 0 : failUsage(named.message());
  }

  std::vector<std::string> outputs(int pictures) const {
    std::vector<std::string> all;
    if (!options_.output.empty() && options_.turntable == 0) all.push_back(options_.output);
    for (int n = 0; !options_.output.empty() && n < pictures; ++n)
      all.push_back(numberedName(options_.output, n));
    for (const std::string& path : {options_.statsFile, options_.errorMap})
      if (!path.empty()) all.push_back(path);
    return all;
  }

  // Checks that all outputs can be written, and that no two are one.
  Status checkOutputs() const {
    const std::vector<std::string> written = outputs(options_.turntable);
    const std::vector<std::string> read = {options_.drawn.path, options_.drawn.scene.sceneFile};
    if (Status s = checkApart(written, read); !s) return s;
    for (const std::string& path : outputs(std::min(1, options_.turntable)))
      if (auto file = OutputFile::create(path); !file) return file.error();
    return {};
  }

  int draw(const SceneToDraw& drawn, const RenderOptions& asked) {
    const int pictures = std::max(1, options_.turntable);
    for (int n = 0; n < pictures; ++n) {
      const double begin = wallMs();
      const auto plan = drawn.plan(asked, n, pictures);
      if (!plan) return failUsage(plan.message());
      times_.planMs += wallMs() - begin;
      if (options_.output.empty() && options_.statsFile.empty()) return settle(*plan, drawn.caches());
      if (const int failed = drawFrames(*plan, drawn.caches())) return failed;
      if (options_.output.empty()) continue;
      const std::string path = options_.turntable ? numberedName(options_.output, n) : options_.output;
      const Status written =
          writePicture(done_, drawn.textOf(done_), drawn.warnings, !options_.noWarningLine, path);
      if (!written) return fail(written.message());
      told() << printable(path) << '\n';
      ++written_;
    }
    if (!options_.errorMap.empty()) return writeErrorMap();
    return exitDone;
  }

  // Writes the error map of the last picture.
  int writeErrorMap() {
    if (done_.error.empty()) return fail("No error map was written. " + whyNoEstimate(done_.plan));
    const Status written = writeMapNrrd(done_.picture.size, done_.error, options_.errorMap);
    if (!written) return fail(written.message());
    told() << printable(options_.errorMap) << '\n';
    return exitDone;
  }

  // Completes the plan without rendering.
  int settle(const Plan& plan, RenderCaches& caches) {
    done_.plan = plan;
    if (!options_.explain) return exitDone;
    RenderStats stats;
    auto done = completedPlan(plan, caches, stats, cancel_);
    if (!done) return stopped(done.message());
    done_.plan = std::move(*done);
    return exitDone;
  }

  // Renders the same view --frames times, for timing.
  int drawFrames(const Plan& plan, RenderCaches& caches) {
    for (int n = 0; n < options_.frames; ++n) {
      const double begin = wallMs();
      auto done = render(plan, caches, cancel_);
      if (!done) return stopped(done.message());
      times_.framesMs.push_back(wallMs() - begin);
      times_.gradientsMs += done->stats.gradientsMs;
      done_ = std::move(*done);
    }
    return 0;
  }

  int stopped(const std::string& why) const {
    if (cancel_.cancelled() && written_ > 0)
      return fail("Interrupted; " + std::to_string(written_) + " of " + std::to_string(options_.turntable) +
                  " pictures were written.");
    return fail(why, cancel_);
  }

  int finish(const SceneToDraw& drawn) {
    const int status = statusWith(drawn.unread);
    if (options_.explain)
      told() << (times_.framesMs.empty() ? explain(done_.plan)
                                         : explain(done_.plan, effectCosts(done_.plan, done_.stats)));
    if (options_.printScene) std::cout << printableJson(sceneToJson(done_.plan.scene));
    if (options_.statsFile.empty()) return status;
    const Status written = writeWholeFile(options_.statsFile, jsonText(statsJson(done_, drawn, times_)));
    return written.ok() ? status : fail(written.message());
  }

  // With --print-scene, stdout holds only the scene, so that it can be read again.
  std::ostream& told() const { return options_.printScene ? std::cerr : std::cout; }

  const RenderArguments& options_;
  const CancelToken& cancel_;
  Times times_;
  Rendered done_;
  int written_ = 0;
};

}  // namespace

std::function<int()> makeRender(CLI::App& app, const CancelToken& cancel) {
  auto o = std::make_shared<RenderArguments>();
  addPath(app, o->drawn.path)->required();
  addPictureOutput(app, o->output, "The picture: .png (8 bits) or .nrrd (floats, for comparison)");
  addSeries(app, o->drawn.series);
  app.add_flag("--remove-table", o->drawn.removeTable,
               "CT: draw the patient alone, without table, cushions and cables");
  addSceneOptions(app, o->drawn.scene);
  addMethodOptions(app, o->drawn.method);
  wholeNumber(app.add_option("--frames", o->frames, "Render the same view N times, for timing"), 1, 100000);
  wholeNumber(app.add_option("--turntable", o->turntable, "Render N pictures of a full turn"), 1, 9999);
  app.add_option("--stats", o->statsFile, "Write times, samples, memory and the plan to this JSON file")
      ->type_name("FILE");
  app.add_option("--error-map", o->errorMap, "Write how far each pixel may be off, in 1/255, as .nrrd")
      ->type_name("FILE");
  addNoWarningLine(app, o->noWarningLine);
  app.add_flag("--explain", o->explain, "Say what is computed for this picture and why");
  app.add_flag("--print-scene", o->printScene, "Write the complete scene in use to stdout");
  addExamples(app, {"volumen render scans/ --preset CT-Bone --view left -o bone.png",
                    "volumen render scans/ --scene bone.png --turntable 12 -o turn.png"});
  return [o, &cancel] { return Run(*o, cancel)(); };
}

}  // namespace volumen
