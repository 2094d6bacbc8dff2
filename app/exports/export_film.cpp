#include <algorithm>
#include <cmath>

#include "app/exports/drawn_pictures.h"
#include "io/export/dicom_file.h"
#include "io/export/film_file.h"
#include "io/files/session_file.h"

namespace volumen {

namespace {

constexpr int picturesOfTurn = 36, usualPerSecond = 10;

Status checkFrames(const ExportJob& job) {
  const PlaneOptions& plane = job.plane;
  if (plane.at || plane.index || plane.mmPerPixel || plane.slabMm > 0 || plane.average || job.spacingMm ||
      job.timePoints || !plane.centre.empty() || !plane.size.empty() || plane.interpolation != "linear")
    return Error{"--plane frame shows pictures as acquired: only --window and --series go with it."};
  return checkWindows(job);
}

Status checkFilm(const ExportJob& job) {
  const PlaneOptions& plane = job.plane;
  if (job.timePoints && !job.hasPlane && job.turntable)
    return Error{"--turntable is for one time point: leave it or --time-points out."};
  if (job.timePoints && isSessionFile(job.path))
    return Error{job.path + " is a session, which shows one time point: name the series instead."};
  if (job.isOfFrames()) return checkFrames(job);
  if (job.timePoints && job.spacingMm)
    return Error{"--spacing is for films through slices: leave it or --time-points out."};
  if (job.spacingMm && !job.hasPlane) return Error{"--spacing is for slices: give --plane too."};
  if (!job.timePoints && (plane.at || plane.index || !plane.centre.empty()))
    return Error{"A film goes through all slices: leave the place of the plane out, or give --time-points."};
  return checkDrawn(job);
}

int perSecond(const ExportJob& job, const Series& series) {
  if (job.framesPerSecond) return *job.framesPerSecond;
  const double own = job.isOfFrames() ? series.cine.framesPerSecond : 0;
  return own > 0 ? std::clamp(int(std::lround(own)), 1, mostPerSecond) : usualPerSecond;
}

Result<Exported> drawFilm(const ExportJob& job, const PictureTaker& taker, const CancelToken& cancel) {
  if (job.isOfFrames()) return drawFrames(job, taker, cancel);
  if (job.hasPlane)
    return drawSlices(job, job.timePoints ? SlicesDrawn::timePoints : SlicesDrawn::all, taker, cancel);
  if (job.timePoints) return drawTimePoints(job, taker, cancel);
  return drawTurn(job, job.turntable.value_or(picturesOfTurn), taker, cancel);
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
  if (auto film = FilmFile::create(job.output, 1, usualPerSecond); !film) return film.error();
  std::unique_ptr<FilmFile> film;
  PictureTaker taker;
  taker.begin = [&](const Series& series, int count) -> Status {
    auto begun = FilmFile::create(job.output, count, perSecond(job, series));
    if (!begun) return begun.error();
    film = *std::move(begun);
    return {};
  };
  taker.take = [&](const QImage& picture, const PictureText& text) {
    return film->add(picture, text, cancel);
  };
  auto drawn = drawFilm(job, taker, cancel);
  if (!drawn) return drawn;
  if (Status s = film->finish(cancel); !s) return s.error();
  return drawn;
}

}  // namespace volumen
