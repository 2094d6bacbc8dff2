#pragma once

#include <QImage>
#include <optional>

#include "io/export/secondary_capture.h"
#include "io/files/picture_file.h"
#include "io/study/series.h"

namespace volumen {

/// Writes images of a series, all of one size, as a Secondary Capture into a new file. The file appears with
/// finish(), or not at all.
class CapturedPictures {
 public:
  /// `tags.derivation` is made from the texts of the first image.
  CapturedPictures(std::string path, Series series, CaptureTags tags, int frames)
      : path_(std::move(path)), series_(std::move(series)), tags_(std::move(tags)), frames_(frames) {}

  /// Takes the next image; what is transparent becomes black. `text` is what its PNG would say. The Error
  /// is one of SecondaryCapture.
  Status take(const QImage& image, const PictureText& text, const CancelToken& cancel);
  Status finish();

 private:
  std::string path_;
  Series series_;
  CaptureTags tags_;
  int frames_;
  std::optional<SecondaryCapture> capture_;
};

/// Returns 3 bytes a pixel without gaps between rows; what is transparent becomes black. Throws bad_alloc.
std::vector<std::uint8_t> rgbOf(const QImage& image);

/// Returns the texts of several pictures: those of the first one, without what holds for it alone.
PictureText textOfAll(PictureText text, int pictures);

/// Returns in words how pictures were made, from the texts of the first one: program, level, stated error,
/// warnings, and a hash instead of a scene (textOfAll()).
std::string derivationWords(const PictureText& text, int pictures);

}  // namespace volumen
