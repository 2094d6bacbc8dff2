#include "app/scene_to_draw.h"

#include <QStringList>
#include <algorithm>
#include <iterator>

#include "io/files/session_file.h"
#include "results/pictures/reduced_copy.h"
#include "results/segments/segment_surfaces.h"
#include "results/segments/segments.h"
#include "results/segments/tissue.h"
#include "viewer/acceleration/stored_voxels.h"
#include "viewer/plan/default_window.h"
#include "viewer/plan/facts.h"
#include "viewer/plan/picture_text.h"

namespace volumen {

namespace {

// One scene is drawn, so gradients of its visible bricks are enough.
std::unique_ptr<RenderCaches> sparingCaches(const VolumePtr& volume) {
  auto voxels = std::make_shared<StoredVoxels>(volume);
  voxels->spareGradients(true);
  return std::make_unique<RenderCaches>(std::move(voxels));
}

// Returns the segments that the session's 3D view draws, and adds notes on those that cannot be drawn.
std::vector<SegmentInScene> segmentsOf(const SessionView& session, const Volume& whole,
                                       std::vector<std::string>& notes, const CancelToken& cancel) {
  const std::vector<SegmentMap>& maps = session.segments;
  std::vector<SegmentInScene> drawn;
  std::vector<SegmentNotDrawn> refused;
  for (const auto& [key, field] : surfacesOf(maps, whole, session.mask, mostSurfaceBytes(), cancel)) {
    const Segment* segment = findSegment(*std::ranges::find(maps, key.map, &SegmentMap::number), key.number);
    if (field)
      drawn.push_back({segment, *field});
    else
      refused.push_back({segment, QString::fromStdString(field.message())});
  }
  if (cancel.cancelled()) return drawn;  // cancelled surfaces are not refused ones
  for (const QString& line : notDrawnText(refused).split(QLatin1Char('\n'), Qt::SkipEmptyParts))
    notes.push_back(line.toStdString());
  const auto missing = std::ranges::count_if(maps, [](const SegmentMap& map) { return !map.labels; });
  const char* which = missing == std::ssize(maps) ? "The" : "Some";
  if (missing > 0)
    notes.push_back(std::string(which) + " segments of the session were not found: they are not drawn.");
  return drawn;
}

Scene asWhole(Scene scene, const Volume& whole) {
  const VolumeFacts facts = factsOf(whole);
  return drawnAsTheWhole(std::move(scene), defaultWindow(facts), facts.p999 - facts.p01, facts.geometry);
}

}  // namespace

Result<AskedScene> readAskedScene(const DrawnOptions& options, const RenderOptions& render,
                                  const CancelToken& cancel) {
  AskedScene asked{{}, {}, render};
  if (isSessionFile(options.path)) {
    auto session = readSessionView(options.path, cancel);
    if (!session) return session.error();
    if (leavesLevelOpen(options.method) && session->quality) asked.options.quality = *session->quality;
    asked.scene = session->scene;
    asked.session = std::move(*session);
    return asked;
  }
  auto scene = readScene(options.scene);
  if (!scene) return scene.error();
  asked.scene = std::move(*scene);
  return asked;
}

std::string saidBySession(const DrawnOptions& options) {
  if (!isSessionFile(options.path)) return {};
  if (!options.series.empty()) return "--series";
  if (!options.scene.sceneFile.empty()) return "--scene";
  if (!options.scene.preset.empty()) return "--preset";
  return options.removeTable ? "--remove-table" : "";
}

Result<SceneToDraw> SceneToDraw::load(const DrawnOptions& options, const AskedScene& asked,
                                      const CancelToken& cancel) {
  const auto& session = asked.session;
  auto opened =
      session ? openSeries(session->series, cancel) : openVolume(options.path, options.series, cancel);
  if (!opened) return opened.error();
  return of(*std::move(opened), options, asked, cancel);
}

Result<SceneToDraw> SceneToDraw::of(Opened opened, const DrawnOptions& options, const AskedScene& asked,
                                    const CancelToken& cancel) {
  const auto& session = asked.session;
  SceneToDraw drawn;
  drawn.series = opened.series, drawn.notes = opened.notes, drawn.timePoints = opened.timePoints;
  drawn.warnings = opened.loaded.warnings, drawn.unread = opened.loaded.unread;
  const VolumePtr whole = opened.loaded.drawn;
  std::vector<SegmentInScene> segments;
  if (session) segments = segmentsOf(*session, *whole, drawn.notes, cancel);
  const Mask mask = session ? session->mask : Mask{options.removeTable, {}};
  if (!mask.empty())
    if (Status taken = takeAway(mask, opened, cancel); !taken) return taken.error();
  drawn.volume_ = opened.loaded.drawn;
  const bool isApart = session && showsTissueApart(*session, *drawn.volume_);
  if (isApart) {
    const auto left = tissueAlone(*session, *drawn.volume_, cancel);
    if (!left) return left.error();
    drawn.volume_ = *left;
  }
  auto scene = makeScene(options.scene, asked.scene, *drawn.volume_);
  if (!scene) return scene.error();
  if (isApart) scene = asWhole(*std::move(scene), *whole);
  for (const SegmentInScene& one : segments) scene->segments.push_back(surfaceOf(*one.segment, one.field));
  drawn.said_ = segmentsInPicture(segments, isApart ? session->segments.front().tissue : TissueShown{});
  drawn.scene_ = *std::move(scene);
  drawn.caches_ = sparingCaches(drawn.volume_);
  return drawn;
}

Status SceneToDraw::fitToMemory(const std::string& path, const RenderOptions& options) {
  const auto first = makePlan(scene_, caches_->facts(), options);
  if (!first) return {};  // plan() reports the reason
  auto copy = copyToDraw(*first, *volume_, caches_->facts(), path, volume_->bytes());
  if (!copy) return copy.error();
  if (!*copy) return {};
  scene_ = first->scene;
  volume_ = (*copy)->volume;
  reducedBy_ = (*copy)->factor;
  caches_ = sparingCaches(volume_);
  notes.push_back((*copy)->warning.sentence);
  warnings.push_back((*copy)->warning);
  return {};
}

Result<Plan> SceneToDraw::plan(const RenderOptions& options, int n, int pictures) const {
  const auto first = makePlan(scene_, caches_->facts(), options);
  if (!first || n == 0) return first;
  Scene next = first->scene;
  *next.camera = turned(*next.camera, 360.0 * n / pictures);
  return makePlan(next, caches_->facts(), options);
}

Result<Scene> SceneToDraw::sceneForOthers(const RenderOptions& options) const {
  const auto first = makePlan(scene_, caches_->facts(), options);
  if (!first) return first.error();
  return asWhole(first->scene, *volume_);
}

PictureText SceneToDraw::textOf(const Rendered& done) const {
  PictureText text = pictureText(done.plan, {.estimated = estimateOf(done.plan, done.error)});
  std::ranges::move(textOfSegments(said_, done.plan.segments), std::back_inserter(text));
  return text;
}

}  // namespace volumen
