#include "ui/controller/thumbnails.h"

#include <QPainter>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "io/frames.h"
#include "ui/controller/frame_picture.h"
#include "ui/data/frame_series.h"
#include "ui/workspace/frame_look.h"

namespace volumen {

namespace {

// A file of more voxels is not read for a thumbnail.
constexpr std::int64_t mostVoxels = 1 << 24;

// The series' slice in the middle alone, where that can be read alone; else the series.
std::optional<Series> toRead(const Series& series) {
  Series part = series;
  if (series.format == "DICOM") {
    if (series.files.empty()) return {};
    const std::size_t middle = series.files.size() / 2;
    part.files = {series.files[middle]};
    part.frames = {series.frames[middle]};
    return part;
  }
  if (series.acquired.voxelCount() > mostVoxels) return {};
  return part;
}

struct Grey {
  double low = 0, high = 1;
  int operator()(double value) const {
    return int(std::lround(255 * std::clamp((value - low) / (high - low), 0.0, 1.0)));
  }
};

// The file's window, else what most of the slice has.
Grey greyOf(const Volume& volume, std::vector<float> slice) {
  if (const auto& windows = volume.attributes().windows; !windows.empty())
    return {windows[0].centre - windows[0].width / 2, windows[0].centre + windows[0].width / 2};
  const auto ofRank = [&](double part) {
    const auto at = slice.begin() + std::ptrdiff_t(part * double(slice.size() - 1));
    std::nth_element(slice.begin(), at, slice.end());
    return double(*at);
  };
  const double low = ofRank(0.01), high = ofRank(0.995);
  return {low, high > low ? high : low + 1};
}

// Right and down in a picture as it is usually looked at, whose slices have this normal.
std::pair<glm::dvec3, glm::dvec3> usualSides(glm::dvec3 normal) {
  const glm::dvec3 n = glm::abs(normal);
  if (n.z >= n.x && n.z >= n.y) return {{1, 0, 0}, {0, 1, 0}};
  return {n.x > n.y ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), {0, 0, -1}};
}

}  // namespace

QImage thumbnailOf(const Volume& volume, int edge) {
  const glm::ivec3 size = volume.size();
  std::vector<float> values;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) values.push_back(volume.value(x, y, size.z / 2));
  const Grey grey = greyOf(volume, values);
  QImage slice(size.x, size.y, QImage::Format_Grayscale8);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      slice.scanLine(y)[x] = uchar(grey(double(values[std::size_t(y) * size.x + x])));
  const VoxelGeometry& g = volume.geometry();
  const glm::dmat3& step = g.patientFromVoxelStep;
  const auto [right, down] = usualSides(glm::cross(step[0], step[1]));
  if (g.calibrated) slice = slice.mirrored(glm::dot(step[0], right) < 0, glm::dot(step[1], down) < 0);
  const glm::dvec3 spacing = g.spacing();
  QSizeF shape(size.x * spacing.x, size.y * spacing.y);
  shape.scale(edge, edge, Qt::KeepAspectRatio);
  const QSize pixels(std::max(1, int(shape.width())), std::max(1, int(shape.height())));
  QImage out(edge, edge, QImage::Format_ARGB32_Premultiplied);
  out.fill(Qt::transparent);
  QPainter(&out).drawImage(QPoint((edge - pixels.width()) / 2, (edge - pixels.height()) / 2),
                           slice.scaled(pixels, Qt::IgnoreAspectRatio, Qt::SmoothTransformation));
  return out;
}

namespace {

std::optional<QImage> sliceThumbnail(const Series& part, int edge, const CancelToken& cancel) {
  const Result<Loaded> loaded = loadSeries(part, {}, cancel);
  if (!loaded) return {};
  return thumbnailOf(*loaded->drawn, edge);
}

// The whole picture, in the middle of a black square.
std::optional<QImage> frameThumbnail(const Series& series, int edge) {
  const int index = frameCount(series) / 2;
  Result<Frame> frame = loadFrame(series, index);
  if (!frame) return {};
  const Result<ShownFramePtr> shown = shownFrame(series, {keyOf(series), index}, std::move(*frame));
  if (!shown) return {};
  SlicePlane plane = framePlane((*shown)->geometry());
  plane.mmPerPixel *= double(std::max(plane.size.x, plane.size.y)) / edge;
  plane.size = {edge, edge};
  plane.average = true;
  const Result<QImage> image = drawFrame(**shown, plane, frameGrey({}, {}, **shown), true);
  if (!image) return {};
  return *image;
}

}  // namespace

Thumbnails::Thumbnails(int edge, QObject* parent) : QObject(parent), edge_(edge) {
  pool_.setMaxThreadCount(1);
  pool_.setThreadPriority(QThread::LowPriority);
}

Thumbnails::~Thumbnails() {
  cancel_.cancel();
  pool_.clear();
  pool_.waitForDone();
}

void Thumbnails::cancel() {
  cancel_.cancel();
  cancel_ = CancelToken();
}

void Thumbnails::request(const Series& series) {
  const std::optional<Series> part = toRead(series);
  if (!part) return;
  pool_.start([this, series, part = *part, cancel = cancel_] {
    if (cancel.cancelled()) return;
    const std::optional<QImage> drawn =
        opensAsFrames(series) ? frameThumbnail(series, edge_) : sliceThumbnail(part, edge_, cancel);
    if (!drawn) return;  // where the series itself cannot be read, a click on it says why
    QMetaObject::invokeMethod(
        this,
        [this, series, thumbnail = *drawn, cancel] {
          if (!cancel.cancelled()) Q_EMIT made(series, thumbnail);
        },
        Qt::QueuedConnection);
  });
}

}  // namespace volumen
