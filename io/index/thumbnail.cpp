#include "io/index/thumbnail.h"

#include <QBuffer>
#include <QImage>
#include <algorithm>

#include "io/frames.h"
#include "viewer/slice/first_window.h"

namespace volumen {
namespace {

QImage greyImage(std::span<const std::uint8_t> greys, int columns, int rows) {
  QImage image(columns, rows, QImage::Format_Grayscale8);
  for (int y = 0; y < rows; ++y)
    std::copy_n(greys.data() + std::size_t(y) * std::size_t(columns), columns, image.scanLine(y));
  return image;
}

QImage imageOf(const Frame& frame) {
  if (!frame.colour())
    return greyImage(greyBytes(frame.values, frame.greys[0].mapping), frame.size.x, frame.size.y);
  return QImage(frame.rgb.data(), frame.size.x, frame.size.y, frame.size.x * 3, QImage::Format_RGB888).copy();
}

/// The middle slice of a volume along its third axis.
Result<QImage> middleSlice(const Series& series, const CancelToken& cancel) {
  const Result<Loaded> loaded = loadSeries(series, {}, cancel);
  if (!loaded) return loaded.error();
  const Volume& volume = *loaded->acquired;
  const glm::ivec3 size = volume.size();
  const std::size_t pixels = std::size_t(size.x) * std::size_t(size.y),
                    first = pixels * std::size_t(size.z / 2);
  std::vector<float> values(pixels);
  for (std::size_t n = 0; n < pixels; ++n) values[n] = volume.valueAt(first + n);
  const GreyMapping grey = windowGrey(volume, false, firstWindow(volume, series.unit));
  return greyImage(greyBytes(values, grey), size.x, size.y);
}

/// An image whose pixels are `mm` wide and high, in square pixels, no longer than a thumbnail.
Result<Thumbnail> pngOf(const QImage& image, glm::dvec2 mm) {
  const bool known = mm.x > 0 && mm.y > 0;
  const double width = image.width() * (known ? mm.x : 1), height = image.height() * (known ? mm.y : 1);
  const double scale = thumbnailEdge / std::max(width, height);
  const auto pixels = [&](double length) { return std::clamp(int(length * scale + 0.5), 1, thumbnailEdge); };
  const QImage small =
      image.scaled(pixels(width), pixels(height), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  if (!small.save(&buffer, "PNG")) return Error{"The thumbnail cannot be written as PNG."};
  return Thumbnail(bytes.begin(), bytes.end());
}

}  // namespace

Result<Thumbnail> makeThumbnail(const std::string& file, const CancelToken& cancel) {
  const Result<Study> study = openFiles({file}, {}, cancel);
  if (!study) return study.error();
  if (!study->volumes.empty() && study->volumes[0].format != "DICOM") {
    const Series& series = study->volumes[0];
    const Result<QImage> slice = middleSlice(series, cancel);
    if (!slice) return slice.error();
    return pngOf(*slice, glm::dvec2(series.acquired.spacing()));
  }
  if (study->volumes.empty() && study->images.empty()) return Error{file + ": it holds no picture."};
  const Result<Frame> frame = study->volumes.empty()
                                  ? loadFrame(study->images[0], study->images[0].frames / 2)
                                  : loadFrame(study->volumes[0], int(study->volumes[0].files.size() / 2));
  if (!frame) return frame.error();
  return pngOf(imageOf(*frame), frame->pixel.mm);
}

}  // namespace volumen
