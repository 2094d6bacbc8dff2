#include "app/exports/exports.h"
#include "app/picture_output.h"
#include "app/progress.h"
#include "app/slice_picture.h"
#include "io/export/captured_pictures.h"
#include "io/export/dicom_file.h"
#include "io/files/session_file.h"
#include "io/paths/open_path.h"
#include "io/study/faces.h"

namespace volumen {

namespace {

Result<CaptureTags> captureTags(const ExportJob& job, const Series& series, const char* description,
                                const CancelToken& cancel) {
  const Result<Study> study = openPath(isSessionFile(job.path) ? series.path : job.path, {}, cancel);
  if (!study) return study.error();
  CaptureTags tags;
  tags.description = description;
  tags.seriesNumber = nextSeriesNumber(*study, series.studyUid);
  tags.hasNames = false;
  tags.frameMs = job.frameMs;
  tags.rle = job.rle;
  return tags;
}

Result<Exported> captureSlice(const ExportJob& job, const CancelToken& cancel) {
  const auto asked = readPlane(job.plane);
  if (!asked) return asked.error();
  const auto window = windowOf(job.window);
  if (!window) return window.error();
  auto opened = openVolume(job.path, job.series, cancel);
  if (!opened) return opened.error();
  noteEvenSlices(job.plane, *opened);
  const auto plane = makePlane(job.plane, *asked, opened->loaded.drawn->geometry());
  if (!plane) return plane.error();
  auto picture = slicePicture(*opened, *plane, *window, cancel);
  if (!picture) return picture.error();
  PictureText text = sliceText(*plane, *picture);
  addWarnings(picture->image, text, opened->loaded.warnings, true);
  auto tags = captureTags(job, opened->series, "Slice", cancel);
  if (!tags) return tags.error();
  tags->showsFace = false;
  CapturedPictures capture(job.output, opened->series, *tags, 1);
  if (Status s = capture.take(picture->image, text, cancel); !s) return s.error();
  if (Status s = capture.finish(); !s) return s.error();
  return Exported{opened->notes, opened->loaded.unread};
}

DrawnOptions drawnOptions(const ExportJob& job) {
  return {job.path, job.series, job.scene, job.method, false};
}

Status drawTurn(const SceneToDraw& drawn, const RenderOptions& options, int pictures,
                CapturedPictures& capture, const CancelToken& cancel) {
  const Progress progress = terminalProgress();
  for (int n = 0; n < pictures; ++n) {
    const auto plan = drawn.plan(options, n, pictures);
    if (!plan) return plan.error();
    const auto done = render(*plan, drawn.caches(), cancel);
    if (!done) return done.error();
    QImage image = imageForFile(done->picture);
    PictureText text = drawn.textOf(*done);
    addWarnings(image, text, drawn.warnings, true);
    if (Status s = capture.take(image, text, cancel); !s) return s;
    if (pictures > 1 && progress) progress("rendering", std::size_t(n) + 1, std::size_t(pictures));
  }
  return capture.finish();
}

Result<Exported> captureScene(const ExportJob& job, const CancelToken& cancel) {
  const DrawnOptions how = drawnOptions(job);
  const auto render = renderOptions(how.scene, how.method);
  if (!render) return render.error();
  const auto asked = readAskedScene(how, *render, cancel);
  if (!asked) return asked.error();
  if (Status s = checkPlan(how.scene, asked->scene, asked->options); !s) return s.error();
  auto drawn = SceneToDraw::load(how, *asked, cancel);
  if (!drawn) return drawn.error();
  if (Status s = drawn->fitToMemory(job.path, asked->options); !s) return s.error();
  auto tags = captureTags(job, drawn->series,
                          job.turntable > 1 ? "Volume rendering, a full turn" : "Volume rendering", cancel);
  if (!tags) return tags.error();
  tags->showsFace = showsFaceIn3d(drawn->series);
  CapturedPictures capture(job.output, drawn->series, *tags, job.turntable);
  const Status done = drawTurn(*drawn, asked->options, job.turntable, capture, cancel);
  endTerminalProgress();
  if (!done) return done.error();
  return Exported{drawn->notes, drawn->unread};
}

}  // namespace

Status checkCapture(const ExportJob& job) {
  if (job.hasPlane) {
    const auto asked = readPlane(job.plane);
    if (!asked) return asked.error();
    const auto window = windowOf(job.window);
    return window ? Status() : Status(window.error());
  }
  if (const std::string said = saidBySession(drawnOptions(job)); !said.empty())
    return Error{job.path + " is a session, which says what is drawn: leave " + said + " out."};
  if (!job.window.empty()) return Error{"--window is for slices: give --plane too."};
  const auto render = renderOptions(job.scene, job.method);
  return render ? Status() : Status(render.error());
}

Result<Exported> exportCapture(const ExportJob& job, const CancelToken& cancel) {
  if (auto file = createNew(job.output); !file) return file.error();  // before minutes are spent on pictures
  return job.hasPlane ? captureSlice(job, cancel) : captureScene(job, cancel);
}

}  // namespace volumen
