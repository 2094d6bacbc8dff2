#pragma once

#include <memory>
#include <string>

#include "io/files/output_file.h"
#include "io/files/picture_file.h"
#include "viewer/volume/cancel.h"

class QImage;

namespace volumen {

/// True for the names of animated PNG files: .png, .apng.
bool isAnimatedPng(const std::string& path);
/// True for the names of MP4 files: .mp4.
bool isMp4(const std::string& path);

/// A film of pictures of one size: an animated PNG, which loops, or MP4, which the program ffmpeg encodes.
/// It is written picture by picture, and appears whole with finish() or not at all.
class FilmFile {
 public:
  /// Begins a film of `pictures` pictures, `perSecond` of them a second, in the format that the name says.
  /// The Error: there is no such format, ffmpeg is not installed, or the file cannot be written.
  static Result<std::unique_ptr<FilmFile>> create(const std::string& path, int pictures, int perSecond);
  virtual ~FilmFile() = default;
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;

  /// Adds the next picture; what is transparent becomes black. `text` is what its PNG would say. The Error:
  /// it has another size than the first one or is one too many, the disk is full, ffmpeg failed, or
  /// cancelled.
  Status add(const QImage& picture, const PictureText& text, const CancelToken& cancel);
  /// Completes the file. The Error: pictures are missing, or one of add().
  Status finish(const CancelToken& cancel);

 protected:
  FilmFile(OutputFile out, std::string path, int pictures, int perSecond)
      : out_(std::move(out)), path_(std::move(path)), pictures_(pictures), perSecond_(perSecond) {}

  Status fail(const std::string& why) const;
  OutputFile& out() { return out_; }
  int pictures() const { return pictures_; }
  int perSecond() const { return perSecond_; }

 private:
  // Receive opaque pictures of one size, the first one with the texts of the film.
  virtual Status writeFirst(const QImage& picture, const PictureText& text, const CancelToken& cancel) = 0;
  virtual Status writeNext(const QImage& picture, const CancelToken& cancel) = 0;
  virtual Status writeEnd(const CancelToken& cancel) = 0;

  OutputFile out_;
  const std::string path_;
  const int pictures_, perSecond_;
  int added_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace volumen
