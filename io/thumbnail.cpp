#include "io/thumbnail.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "io/frames.h"
#include "io/load.h"
#include "io/study/image.h"
#include "io/study/series.h"
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
    return greyImage(frame.values.greyBytes(frame.greys[0].mapping), frame.size.x, frame.size.y);
  return QImage(frame.rgb.data(), frame.size.x, frame.size.y, frame.size.x * 3, QImage::Format_RGB888).copy();
}

// Returns right and down in the usual view of slices with this normal.
std::pair<glm::dvec3, glm::dvec3> usualSides(glm::dvec3 normal) {
  const glm::dvec3 n = glm::abs(normal);
  if (n.z >= n.x && n.z >= n.y) return {{1, 0, 0}, {0, 1, 0}};
  return {n.x > n.y ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), {0, 0, -1}};
}

// Flips a slice of this volume to its usual view.
QImage upright(const QImage& slice, const VoxelGeometry& geometry) {
  if (!geometry.calibrated) return slice;
  const glm::dmat3& step = geometry.patientFromVoxelStep;
  const auto [right, down] = usualSides(glm::cross(step[0], step[1]));
  return slice.mirrored(glm::dot(step[0], right) < 0, glm::dot(step[1], down) < 0);
}

// Scales an image with pixels `mm` wide and high to square pixels; unknown sizes count as square.
QImage scaled(const QImage& image, glm::dvec2 mm, int edge) {
  const bool known = mm.x > 0 && mm.y > 0;
  const double width = image.width() * (known ? mm.x : 1), height = image.height() * (known ? mm.y : 1);
  const double scale = edge / std::max(width, height);
  const auto pixels = [&](double length) { return std::clamp(int(length * scale + 0.5), 1, edge); };
  return image.scaled(pixels(width), pixels(height), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

}  // namespace

QImage thumbnailOf(const Volume& volume, const std::string& unit, int edge) {
  const glm::ivec3 size = volume.size();
  const std::size_t pixels = std::size_t(size.x) * std::size_t(size.y),
                    first = pixels * std::size_t(size.z / 2);
  std::vector<float> values(pixels);
  for (std::size_t n = 0; n < pixels; ++n) values[n] = volume.valueAt(first + n);
  const GreyMapping grey = windowGrey(volume, false, firstWindow(volume, unit));
  const QImage slice = greyImage(greyBytes(values, grey), size.x, size.y);
  return scaled(upright(slice, volume.geometry()), glm::dvec2(volume.geometry().spacing()), edge);
}

Result<QImage> thumbnailOf(const Series& series, int edge, const CancelToken& cancel) {
  if (series.format != "DICOM") {
    const Result<Loaded> loaded = loadSeries(series, {}, cancel);
    if (!loaded) return loaded.error();
    return thumbnailOf(*loaded->acquired, series.unit, edge);
  }
  const Result<Frame> frame = loadSmallFrame(series, int(series.files.size() / 2), edge);
  if (!frame) return frame.error();
  return thumbnailOf(*frame, series, edge);
}

QImage thumbnailOf(const Frame& middle, const Series& series, int edge) {
  const QImage picture = imageOf(middle);
  return scaled(series.notVolume.empty() ? upright(picture, series.acquired) : picture, middle.pixel.mm,
                edge);
}

Result<QImage> thumbnailOf(const Image& image, int edge) {
  const Result<Frame> frame = loadSmallFrame(image, image.frames / 2, edge);
  if (!frame) return frame.error();
  return scaled(imageOf(*frame), frame->pixel.mm, edge);
}

}  // namespace volumen
