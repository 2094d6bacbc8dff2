#include "io/export/film_file.h"

#include <QImage>
#include <new>

#include "io/export/captured_pictures.h"
#include "io/export/film_formats.h"

namespace volumen {

namespace {

bool endsIn(const std::string& path, const char* ending) {
  return QString::fromStdString(path).endsWith(QLatin1String(ending), Qt::CaseInsensitive);
}

}  // namespace

bool isAnimatedPng(const std::string& path) { return endsIn(path, ".png") || endsIn(path, ".apng"); }

bool isMp4(const std::string& path) { return endsIn(path, ".mp4"); }

Result<std::unique_ptr<FilmFile>> FilmFile::create(const std::string& path, int pictures, int perSecond) {
  if (pictures < 1) return Error{"Cannot write " + path + ": a film needs a picture."};
  if (isAnimatedPng(path)) return beginAnimatedPng(path, pictures, perSecond);
  if (isMp4(path)) return beginMp4(path, pictures, perSecond);
  return Error{path + ": films are written as .png or .apng (animated PNG) or as .mp4."};
}

Status FilmFile::fail(const std::string& why) const {
  return Error{"Cannot write " + path_ + ": " + why + "."};
}

Status FilmFile::add(const QImage& picture, const PictureText& text, const CancelToken& cancel) try {
  if (cancel.cancelled()) return Error{"Cancelled."};
  if (added_ == pictures_) return fail("there are more than " + std::to_string(pictures_) + " pictures");
  if (added_++ == 0) {
    width_ = picture.width(), height_ = picture.height();
    return writeFirst(opaqueImage(picture), textOfAll(text, pictures_), cancel);
  }
  if (picture.width() != width_ || picture.height() != height_)
    return fail("picture " + std::to_string(added_) + " has " + std::to_string(picture.width()) + " x " +
                std::to_string(picture.height()) + " pixels, the first one " + std::to_string(width_) +
                " x " + std::to_string(height_) + "; choose one size for all");
  return writeNext(opaqueImage(picture), cancel);
} catch (const std::bad_alloc&) {
  return fail("there is not enough memory");
}

Status FilmFile::finish(const CancelToken& cancel) {
  if (added_ < pictures_)
    return fail("it has " + std::to_string(added_) + " of " + std::to_string(pictures_) + " pictures");
  if (Status s = writeEnd(cancel); !s) return s;
  return out_.commit();
}

}  // namespace volumen
