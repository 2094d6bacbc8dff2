#include "app/exports/drawn_pictures.h"
#include "io/export/dicom_file.h"
#include "io/export/film_file.h"

namespace volumen {

namespace {

constexpr int picturesOfTurn = 36;

Status checkFilm(const ExportJob& job) {
  const PlaneOptions& plane = job.plane;
  if (job.timePoints && !job.hasPlane) return Error{"--time-points is for slices: give --plane too."};
  if (job.timePoints && job.spacingMm)
    return Error{"--spacing is for films through slices: leave it or --time-points out."};
  if (job.spacingMm && !job.hasPlane) return Error{"--spacing is for slices: give --plane too."};
  if (!job.timePoints && (plane.at || plane.index || !plane.centre.empty()))
    return Error{"A film goes through all slices: leave the place of the plane out, or give --time-points."};
  return checkDrawn(job);
}

}  // namespace

Status checkAnimatedPng(const ExportJob& job) {
  if (!isAnimatedPng(job.output)) return Error{job.output + ": animated PNG files end in .png or .apng."};
  return checkFilm(job);
}

Status checkMp4(const ExportJob& job) {
  if (!isMp4(job.output)) return Error{job.output + ": MP4 files end in .mp4."};
  return checkFilm(job);
}

Result<Exported> exportFilm(const ExportJob& job, const CancelToken& cancel) {
  // A file that cannot be written is told before minutes are spent on pictures.
  if (auto file = createNew(job.output); !file) return file.error();
  if (auto film = FilmFile::create(job.output, 1, job.framesPerSecond); !film) return film.error();
  std::unique_ptr<FilmFile> film;
  PictureTaker taker;
  taker.begin = [&](const Series&, int count) -> Status {
    auto begun = FilmFile::create(job.output, count, job.framesPerSecond);
    if (!begun) return begun.error();
    film = *std::move(begun);
    return {};
  };
  taker.take = [&](const QImage& picture, const PictureText& text) {
    return film->add(picture, text, cancel);
  };
  const auto slices = job.timePoints ? SlicesDrawn::timePoints : SlicesDrawn::all;
  auto drawn = job.hasPlane ? drawSlices(job, slices, taker, cancel)
                            : drawTurn(job, job.turntable.value_or(picturesOfTurn), taker, cancel);
  if (!drawn) return drawn;
  if (Status s = film->finish(cancel); !s) return s.error();
  return drawn;
}

}  // namespace volumen
