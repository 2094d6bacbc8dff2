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

}  // namespace

Result<Exported> exportCapture(const ExportJob& job, const CancelToken& cancel) {
  if (auto file = createNew(job.output); !file) return file.error();  // before minutes are spent on pictures
  const int pictures = job.turntable.value_or(1);
  const char* description = job.hasPlane   ? "Slice"
                            : pictures > 1 ? "Volume rendering, a full turn"
                                           : "Volume rendering";
  std::optional<CapturedPictures> capture;
  PictureTaker taker;
  taker.begin = [&](const Series& series, int count) -> Status {
    const auto tags = captureTags(job, series, description, cancel);
    if (!tags) return tags.error();
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
  return drawn;
}

}  // namespace volumen
