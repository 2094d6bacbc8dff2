#include <QImage>
#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/open_volume.h"
#include "app/picture_output.h"
#include "app/render_options.h"
#include "app/session_view.h"
#include "app/usage.h"
#include "io/files/output_file.h"
#include "io/files/session_file.h"
#include "results/pictures/reduced_copy.h"
#include "results/segments/segment_picture_text.h"
#include "results/segments/segment_surfaces.h"
#include "results/segments/segments.h"
#include "results/segments/tissue.h"
#include "viewer/acceleration/stored_voxels.h"
#include "viewer/plan/default_window.h"
#include "viewer/plan/facts.h"
#include "viewer/plan/picture_text.h"
#include "viewer/render/effect_costs.h"
#include "viewer/render/render.h"
#include "viewer/scene/scene_json.h"
#include "viewer/segment/mask.h"
#include "viewer/volume/clock.h"

namespace volumen {

namespace {

struct RenderArguments {
  std::string path, series, output, statsFile, errorMap;
  SceneOptions scene;
  MethodOptions method;
  int frames = 1, turntable = 0;
  bool noWarningLine = false, explain = false, printScene = false, removeTable = false;
};

// Times that the command measures itself.
struct Times {
  double loadMs = 0, planMs = 0, gradientsMs = 0, totalMs = 0;
  std::vector<double> framesMs;
};

// Returns the text entries of the image's PNG.
PictureText textOf(const Rendered& done, const SegmentsInPicture& segments) {
  PictureText text = pictureText(done.plan, {.estimated = estimateOf(done.plan, done.error)});
  std::ranges::move(textOfSegments(segments, done.plan.segments), std::back_inserter(text));
  return text;
}

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

nlohmann::ordered_json statsJson(const Rendered& done, const SegmentsInPicture& segments, const Times& t,
                                 const Volume& volume) {
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
                              {{"volume", volume.bytes()},
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
  out["picture"] = pictureJson(textOf(done, segments));
  return out;
}

Status writePicture(const Rendered& done, const PictureText& text, const std::vector<Warning>& warnings,
                    bool warningLine, const std::string& path) {
  if (isFloatPicture(path)) return writePictureNrrd(done.picture, path);
  return writePictureWithWarnings(imageForFile(done.picture), text, warnings, warningLine, path);
}

// Returns "head-007.png" for "head.png" and 7.
std::string numbered(const std::string& path, int n) {
  const std::size_t dot = path.rfind('.');
  char number[16];
  std::snprintf(number, sizeof number, "-%03d", n);
  return path.substr(0, dot) + number + path.substr(dot);
}

// One scene is drawn, so gradients of its visible bricks are enough.
std::shared_ptr<StoredVoxels> sparing(const VolumePtr& volume) {
  auto voxels = std::make_shared<StoredVoxels>(volume);
  voxels->spareGradients(true);
  return voxels;
}

class Run {
 public:
  Run(const RenderArguments& options, const CancelToken& cancel) : options_(options), cancel_(cancel) {}

  int operator()() {
    const double begin = wallMs();
    if (const int wrong = checkUsage()) return wrong;
    auto asked = renderOptions(options_.scene, options_.method);
    if (!asked) return failUsage(asked.message());
    asked->withError = !options_.errorMap.empty();
    std::optional<SessionView> session;
    if (isSessionFile(options_.path)) {
      auto read = readSessionView(options_.path, cancel_);
      if (!read) return fail(read.message(), cancel_);
      if (leavesLevelOpen(options_.method) && read->quality) asked->quality = *read->quality;
      session = std::move(*read);
    }
    const auto file = session ? Result(std::optional(session->scene)) : readScene(options_.scene);
    if (!file) return fail(file.message());
    if (Status s = checkPlan(options_.scene, *file, *asked); !s) return failUsage(s.message());
    if (Status s = checkOutputs(); !s) return fail(s.message());
    auto opened =
        session ? openSeries(session->series, cancel_) : openVolume(options_.path, options_.series, cancel_);
    if (!opened) return fail(opened.message(), cancel_);
    printNotes(opened->notes);
    const Mask mask = session ? session->mask : Mask{options_.removeTable, {}};
    std::vector<SegmentInScene> segments;
    if (session) segments = segmentsOf(*session, *opened->loaded.drawn);
    VolumePtr whole = opened->loaded.drawn;
    if (!mask.empty())
      if (Status taken = takeAway(mask, *opened, cancel_); !taken) return stopped(taken.message());
    volume_ = opened->loaded.drawn;
    const bool isApart = session && showsTissueApart(*session);
    if (isApart)
      if (Status left = leaveTissue(*session); !left) return stopped(left.message());
    warnings_ = opened->loaded.warnings;
    unread_ = opened->loaded.unread;
    times_.loadMs = wallMs() - begin;
    auto scene = makeScene(options_.scene, *file, *volume_);
    if (!scene) return fail(scene.message());
    if (isApart) scene = asWhole(*std::move(scene), *whole);
    for (const SegmentInScene& one : segments) scene->segments.push_back(surfaceOf(*one.segment, one.field));
    said_ = segmentsInPicture(segments, isApart ? session->segments.front().tissue : TissueShown{});
    std::optional<RenderCaches> caches(sparing(volume_));
    const int exit = opened->status();
    whole.reset(), opened = Error{};
    if (Status fits = fitToMemory(*scene, *asked, caches); !fits) return fail(fits.message());
    const int status = draw(*scene, *asked, *caches);
    times_.totalMs = wallMs() - begin;
    return status == exitDone ? finish(exit) : status;
  }

 private:
  int checkUsage() const {
    const bool quiet = options_.explain || options_.printScene || !options_.statsFile.empty();
    if (options_.output.empty() && !quiet)
      return failUsage("Missing output file: use -o PICTURE (.png or .nrrd).");
    if (const std::string said = saidBySession(); !said.empty())
      return failUsage(options_.path + " is a session, which says what is drawn: leave " + said + " out.");
    if (options_.output.empty()) return 0;
    const Status named = checkPictureName(options_.output);
    return named ? 0 : failUsage(named.message());
  }

  // Returns an option that contradicts the rendered session; empty: none.
  std::string saidBySession() const {
    if (!isSessionFile(options_.path)) return {};
    if (!options_.series.empty()) return "--series";
    if (!options_.scene.sceneFile.empty()) return "--scene";
    if (!options_.scene.preset.empty()) return "--preset";
    return options_.removeTable ? "--remove-table" : "";
  }

  // Returns the segments that the session's 3D view draws, and notes those that cannot be drawn.
  std::vector<SegmentInScene> segmentsOf(const SessionView& session, const Volume& whole) const {
    const std::vector<SegmentMap>& maps = session.segments;
    std::vector<SegmentInScene> drawn;
    std::vector<SegmentNotDrawn> refused;
    for (const auto& [key, field] : surfacesOf(maps, whole, session.mask, mostSurfaceBytes(), cancel_)) {
      const Segment* segment =
          findSegment(*std::ranges::find(maps, key.map, &SegmentMap::number), key.number);
      if (field)
        drawn.push_back({segment, *field});
      else
        refused.push_back({segment, QString::fromStdString(field.message())});
    }
    if (cancel_.cancelled()) return drawn;  // cancelled surfaces are not refused ones
    for (const QString& line : notDrawnText(refused).split(QLatin1Char('\n'), Qt::SkipEmptyParts))
      printNotes({line.toStdString()});
    const auto missing = std::ranges::count_if(maps, [](const SegmentMap& map) { return !map.labels; });
    const char* which = missing == std::ssize(maps) ? "The" : "Some";
    if (missing > 0)
      printNotes({std::string(which) + " segments of the session were not found: they are not drawn."});
    return drawn;
  }

  // True if the volume itself is visible only inside or outside segments.
  bool showsTissueApart(const SessionView& session) const {
    return std::ranges::any_of(session.segments, [&](const SegmentMap& map) {
      return map.tissue.where != TissueShown::Where::everywhere && isOn(map, volume_->geometry());
    });
  }

  // Masks the volume as in the session's 3D view.
  Status leaveTissue(const SessionView& session) {
    std::vector<const SegmentMap*> maps;
    for (const SegmentMap& map : session.segments) maps.push_back(&map);
    const BitMask voxels =
        tissueVoxels(segmentsShownOf(maps, volume_->geometry()), maps.front()->tissue, cancel_);
    const Result<VolumePtr> left = keptAlone(*volume_, voxels, cancel_);
    if (!left) return left.error();
    volume_ = *left;
    return {};
  }

  static Scene asWhole(Scene scene, const Volume& whole) {
    const VolumeFacts facts = factsOf(whole);
    return drawnAsTheWhole(std::move(scene), defaultWindow(facts), facts.p999 - facts.p01, facts.geometry);
  }

  // Checks that all outputs can be written.
  Status checkOutputs() const {
    const std::string picture =
        options_.turntable && !options_.output.empty() ? numbered(options_.output, 0) : options_.output;
    for (const std::string& path : {picture, options_.statsFile, options_.errorMap}) {
      if (path.empty()) continue;
      if (auto file = OutputFile::create(path); !file) return file.error();
    }
    return {};
  }

  // If there is too little memory for the volume, draws a reduced copy of it instead.
  Status fitToMemory(Scene& scene, const RenderOptions& asked, std::optional<RenderCaches>& caches) {
    const auto plan = makePlan(scene, caches->facts(), asked);
    if (!plan) return {};  // draw() reports the reason
    auto copy = copyToDraw(*plan, *volume_, caches->facts(), options_.path, volume_->bytes());
    if (!copy) return copy.error();
    if (!*copy) return {};
    scene = plan->scene;
    volume_ = (*copy)->volume;
    reducedBy_ = (*copy)->factor;
    caches.emplace(sparing(volume_));
    printNotes({(*copy)->warning.sentence});
    warnings_.push_back((*copy)->warning);
    return {};
  }

  int draw(const Scene& scene, const RenderOptions& asked, RenderCaches& caches) {
    const int pictures = std::max(1, options_.turntable);
    for (int n = 0; n < pictures; ++n) {
      const double begin = wallMs();
      auto plan = makePlan(scene, caches.facts(), asked);
      if (plan && n > 0) {
        Scene next = plan->scene;
        *next.camera = turned(*next.camera, 360.0 * n / pictures);
        plan = makePlan(next, caches.facts(), asked);
      }
      if (!plan) return failUsage(plan.message());
      times_.planMs += wallMs() - begin;
      if (options_.output.empty() && options_.statsFile.empty()) return settle(*plan, caches);
      if (const int failed = drawFrames(*plan, caches)) return failed;
      if (options_.output.empty()) continue;
      const std::string path = options_.turntable ? numbered(options_.output, n) : options_.output;
      const Status written =
          writePicture(done_, textOf(done_, said_), warnings_, !options_.noWarningLine, path);
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

  int finish(int status) {
    if (options_.explain)
      told() << (times_.framesMs.empty() ? explain(done_.plan)
                                         : explain(done_.plan, effectCosts(done_.plan, done_.stats)));
    if (options_.printScene) std::cout << printableJson(sceneToJson(done_.plan.scene));
    if (options_.statsFile.empty()) return status;
    nlohmann::ordered_json stats = statsJson(done_, said_, times_, *volume_);
    stats["reducedBy"] = reducedBy_;
    stats["warnings"] = sentences(warnings_);
    stats["unread"] = unreadJson(unread_);
    const Status written = writeWholeFile(options_.statsFile, jsonText(stats));
    return written.ok() ? status : fail(written.message());
  }

  // With --print-scene, stdout holds only the scene, so that it can be read again.
  std::ostream& told() const { return options_.printScene ? std::cerr : std::cout; }

  const RenderArguments& options_;
  const CancelToken& cancel_;
  VolumePtr volume_;
  std::vector<Warning> warnings_;
  std::vector<Unread> unread_;
  SegmentsInPicture said_;
  Times times_;
  Rendered done_;
  int written_ = 0;
  int reducedBy_ = 1;  // along each axis
};

}  // namespace

std::function<int()> makeRender(CLI::App& app, const CancelToken& cancel) {
  auto o = std::make_shared<RenderArguments>();
  addPath(app, o->path)->required();
  addPictureOutput(app, o->output, "The picture: .png (8 bits) or .nrrd (floats, for comparison)");
  addSeries(app, o->series);
  app.add_flag("--remove-table", o->removeTable,
               "CT: draw the patient alone, without table, cushions and cables");
  addSceneOptions(app, o->scene);
  addMethodOptions(app, o->method);
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
