#include "ui/controller/thumbnails.h"

#include <QPainter>

#include "io/thumbnail.h"

namespace volumen {

namespace {

// Files with more voxels are not read for a thumbnail.
constexpr std::int64_t mostVoxels = 1 << 24;

bool canBeRead(const Series& series) {
  return series.format == "DICOM" ? !series.files.empty() : series.acquired.voxelCount() <= mostVoxels;
}

}  // namespace

QImage squareThumbnail(const QImage& thumbnail, int edge) {
  QImage out(edge, edge, QImage::Format_ARGB32_Premultiplied);
  out.fill(Qt::transparent);
  QPainter(&out).drawImage((edge - thumbnail.width()) / 2, (edge - thumbnail.height()) / 2, thumbnail);
  return out;
}

Thumbnails::Thumbnails(int edge, QObject* parent) : QObject(parent), edge_(edge) {}

void Thumbnails::request(const Series& series) {
  if (!canBeRead(series)) return;
  lane_.run(
      {},
      [series, edge = edge_](const Job& job) {
        Result<QImage> image = thumbnailOf(series, edge, job.cancel());
        if (image) *image = squareThumbnail(*image, edge);
        return image;
      },
      [this, series](const Result<QImage>& image) {
        // If the series cannot be read, a click on it says why.
        if (image) Q_EMIT made(series, *image);
      });
}

}  // namespace volumen
