#include <optional>

#include "app/exports/drawn_pictures.h"
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
  tags.showsFace = job.hasPlane ? std::optional(false) : showsFaceIn3d(series);
  tags.frameMs = job.frameMs;
  tags.rle = job.rle;
  return tags;
}

// Returns the size of the pictures, where the options say it.
Result<std::optional<glm::ivec2>> sizeOfPictures(const ExportJob& job) {
  if (job.hasPlane) {
    const auto asked = readPlane(job.plane);
    if (!asked) return asked.error();
    return asked->size;
  }
  const auto render = renderOptions(job.scene, job.method);
  if (!render) return render.error();
  return std::optional(render->size);
}

}  // namespace

Status checkCapture(const ExportJob& job) {
  if (Status s = checkDrawn(job); !s) return s;
  const auto size = sizeOfPictures(job);
  if (!size || !*size) return size ? Status() : size.error();
  CaptureTags tags;
  tags.rle = job.rle;
  return checkCaptureFrames(job.output, **size, job.turntable.value_or(1), tags);
}

Result<Exported> exportCapture(const ExportJob& job, const CancelToken& cancel) {
  if (auto file = createNew(job.output); !file) return file.error();  // before minutes are spent on pictures
  const int pictures = job.turntable.value_or(1);
  const char* description = job.hasPlane   ? "Slice"
                            : pictures > 1 ? "Volume rendering, a full turn"
                                           : "Volume rendering";
  std::optional<CapturedPictures> capture;
  bool showsFace = false;
  PictureTaker taker;
  taker.begin = [&](const Series& series, int count) -> Status {
    const auto tags = captureTags(job, series, description, cancel);
    if (!tags) return tags.error();
    showsFace = tags->showsFace.value_or(false);
    capture.emplace(job.output, series, *tags, count);
    return {};
  };
  taker.take = [&](const QImage& picture, const PictureText& text) {
    return capture->take(picture, text, cancel);
  };
  auto drawn = job.hasPlane ? drawSlices(job, SlicesDrawn::one, taker, cancel)
                            : drawTurn(job, pictures, taker, cancel);
  if (!drawn) return drawn;
  if (Status s = capture->finish(); !s) return s.error();
  if (showsFace)
    drawn->notes.emplace_back("A face may be recognised in the picture: look at it before you hand it on.");
  return drawn;
}

}  // namespace volumen
