#include "app/exports/drawn_pictures.h"

#include <QImage>

#include "app/exports/plane_stack.h"
#include "app/picture_output.h"
#include "app/progress.h"
#include "app/slice_picture.h"
#include "viewer/slice/first_window.h"

namespace volumen {

namespace {

DrawnOptions drawnOptions(const ExportJob& job) {
  return {job.path, job.series, job.scene, job.method, job.removeTable};
}

// What slices are drawn by.
struct SliceLook {
  std::optional<Window> window;
  std::optional<Overlay> overlay;
};

Status takeSlice(const Opened& opened, const SlicePlane& plane, const SliceLook& look,
                 const PictureTaker& taker, const CancelToken& cancel) {
  auto picture = slicePicture(opened, plane, look.window, look.overlay, cancel);
  if (!picture) return picture.error();
  PictureText text = sliceText(plane, *picture);
  addWarnings(picture->image, text, opened.loaded.warnings, true);
  return taker.take(picture->image, text);
}

Status takeStack(const Opened& opened, const SliceStack& stack, const SliceLook& look,
                 const PictureTaker& taker, const CancelToken& cancel) {
  const Progress progress = terminalProgress();
  if (Status s = taker.begin(opened.series, stack.count); !s) return s;
  for (int n = 0; n < stack.count; ++n) {
    if (Status s = takeSlice(opened, stack.plane(n), look, taker, cancel); !s) return s;
    if (stack.count > 1 && progress) progress("drawing", std::size_t(n) + 1, std::size_t(stack.count));
  }
  return {};
}

Error onlyOneTimePoint(const Series& series) {
  return Error{"Series " + series.id + " has only one time point: leave --time-points out."};
}

// Reads one time point after another.
Status takeTimePoints(Opened& opened, const SlicePlane& plane, const std::optional<Window>& window,
                      const PictureTaker& taker, const CancelToken& cancel) {
  if (opened.timePoints.empty()) return onlyOneTimePoint(opened.series);
  const Window shown = window ? *window : firstWindow(*opened.loaded.drawn, opened.series.unit);
  if (Status s = taker.begin(opened.series, int(opened.timePoints.size())); !s) return s;
  for (const Series& step : opened.timePoints) {
    const auto at = openSeries(step, cancel);
    if (!at) return at.error();
    if (Status s = takeSlice(*at, plane, {shown, {}}, taker, cancel); !s) return s;
    addUnread(opened.loaded.unread, at->loaded.unread);
  }
  return {};
}

Result<SliceStack> slicesOf(const ExportJob& job, SlicesDrawn which, const AskedPlane& asked,
                            const VoxelGeometry& geometry) {
  if (which == SlicesDrawn::all) return planeStack(job, asked, geometry);
  const auto plane = makePlane(job.plane, asked, geometry);
  if (!plane) return plane.error();
  return SliceStack{*plane, 1, 1};
}

// Draws picture `n` of a turn that has `pictures` of them.
Status takeRendering(const SceneToDraw& drawn, const RenderOptions& options, int n, int pictures,
                     const PictureTaker& taker, const CancelToken& cancel) {
  const auto plan = drawn.plan(options, n, pictures);
  if (!plan) return plan.error();
  const auto done = render(*plan, drawn.caches(), cancel);
  if (!done) return done.error();
  QImage image = imageForFile(done->picture);
  PictureText text = drawn.textOf(*done);
  addWarnings(image, text, drawn.warnings, true);
  return taker.take(image, text);
}

Status takeTurn(const SceneToDraw& drawn, const RenderOptions& options, int pictures,
                const PictureTaker& taker, const CancelToken& cancel) {
  const Progress progress = terminalProgress();
  for (int n = 0; n < pictures; ++n) {
    if (Status s = takeRendering(drawn, options, n, pictures, taker, cancel); !s) return s;
    if (pictures > 1 && progress) progress("rendering", std::size_t(n) + 1, std::size_t(pictures));
  }
  return {};
}

// Loads the scene of a job, with a reduced copy of its volume where memory is scarce.
Result<SceneToDraw> sceneToDraw(const DrawnOptions& how, const AskedScene& asked, const CancelToken& cancel) {
  if (Status s = checkPlan(how.scene, asked.scene, asked.options); !s) return s.error();
  auto drawn = SceneToDraw::load(how, asked, cancel);
  if (!drawn) return drawn.error();
  if (Status s = drawn->fitToMemory(how.path, asked.options); !s) return s.error();
  return drawn;
}

// Draws one time point by the scene in `asked`.
Status takeTimePoint(const Series& step, const DrawnOptions& how, const AskedScene& asked,
                     const PictureTaker& taker, Exported& exported, const CancelToken& cancel) {
  auto opened = openSeries(step, cancel);
  if (!opened) return opened.error();
  auto drawn = SceneToDraw::of(*std::move(opened), how, asked, cancel);
  if (!drawn) return drawn.error();
  if (Status s = drawn->fitToMemory(how.path, asked.options); !s) return s;
  if (Status s = takeRendering(*drawn, asked.options, 0, 1, taker, cancel); !s) return s;
  addUnread(exported.unread, drawn->unread);
  return {};
}

}  // namespace

Status checkDrawn(const ExportJob& job) {
  if (job.hasPlane) {
    const auto asked = readPlane(job.plane);
    if (!asked) return asked.error();
    return checkWindows(job);
  }
  if (const std::string said = saidBySession(drawnOptions(job)); !said.empty())
    return Error{job.path + " is a session, which says what is drawn: leave " + said + " out."};
  if (job.overlay.isGiven()) return Error{"--overlay is for slices: give --plane too."};
  if (!job.window.empty()) return Error{"--window is for slices: give --plane too."};
  const auto render = renderOptions(job.scene, job.method);
  return render ? Status() : Status(render.error());
}

Result<Exported> drawSlices(const ExportJob& job, SlicesDrawn which, const PictureTaker& taker,
                            const CancelToken& cancel) {
  const auto asked = readPlane(job.plane);
  if (!asked) return asked.error();
  const auto window = windowOf(job.window);
  if (!window) return window.error();
  auto opened = openVolume(job.path, job.series, cancel);
  if (!opened) return opened.error();
  noteEvenSlices(job.plane, *opened);
  const auto stack = slicesOf(job, which, *asked, opened->loaded.drawn->geometry());
  if (!stack) return stack.error();
  auto overlay = openOverlay(job.overlay, job.relation, job.path, *opened, cancel);
  if (!overlay) return overlay.error();
  const SliceLook look{*window, *std::move(overlay)};
  const Status taken = which == SlicesDrawn::timePoints
                           ? takeTimePoints(*opened, stack->first, *window, taker, cancel)
                           : takeStack(*opened, *stack, look, taker, cancel);
  endTerminalProgress();
  if (!taken) return taken.error();
  return Exported{opened->notes, opened->loaded.unread};
}

Result<Exported> drawTurn(const ExportJob& job, int pictures, const PictureTaker& taker,
                          const CancelToken& cancel) {
  const DrawnOptions how = drawnOptions(job);
  const auto render = renderOptions(how.scene, how.method);
  if (!render) return render.error();
  const auto asked = readAskedScene(how, *render, cancel);
  if (!asked) return asked.error();
  const auto drawn = sceneToDraw(how, *asked, cancel);
  if (!drawn) return drawn.error();
  if (Status s = taker.begin(drawn->series, pictures); !s) return s.error();
  const Status taken = takeTurn(*drawn, asked->options, pictures, taker, cancel);
  endTerminalProgress();
  if (!taken) return taken.error();
  return Exported{drawn->notes, drawn->unread};
}

Result<Exported> drawTimePoints(const ExportJob& job, const PictureTaker& taker, const CancelToken& cancel) {
  const DrawnOptions how = drawnOptions(job);
  const auto render = renderOptions(how.scene, how.method);
  if (!render) return render.error();
  auto asked = readAskedScene(how, *render, cancel);
  if (!asked) return asked.error();
  std::vector<Series> steps;
  Exported exported;
  {  // one volume at a time is in memory
    const auto chosen = sceneToDraw(how, *asked, cancel);
    if (!chosen) return chosen.error();
    if (chosen->timePoints.empty()) return onlyOneTimePoint(chosen->series);
    auto scene = chosen->sceneForOthers(asked->options);
    if (!scene) return scene.error();
    asked->scene = *std::move(scene);
    steps = chosen->timePoints, exported = {chosen->notes, chosen->unread};
    if (Status s = taker.begin(chosen->series, int(steps.size())); !s) return s.error();
  }
  const DrawnOptions each{how.path, {}, {}, how.method, how.removeTable};
  const Progress progress = terminalProgress();
  Status taken;
  for (std::size_t n = 0; n < steps.size() && taken; ++n) {
    taken = takeTimePoint(steps[n], each, *asked, taker, exported, cancel);
    if (progress) progress("rendering", n + 1, steps.size());
  }
  endTerminalProgress();
  if (!taken) return taken.error();
  return exported;
}

}  // namespace volumen
