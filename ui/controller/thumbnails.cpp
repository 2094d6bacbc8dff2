#include "ui/controller/thumbnails.h"

#include <QPainter>

#include "io/thumbnail.h"

namespace volumen {

namespace {

// A file of more voxels is not read for a thumbnail.
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
  if (!canBeRead(series)) return;
  pool_.start([this, series, cancel = cancel_] {
    if (cancel.cancelled()) return;
    const Result<QImage> image = thumbnailOf(series, edge_, cancel);
    if (!image) return;  // where the series itself cannot be read, a click on it says why
    QMetaObject::invokeMethod(
        this,
        [this, series, thumbnail = squareThumbnail(*image, edge_), cancel] {
          if (!cancel.cancelled()) Q_EMIT made(series, thumbnail);
        },
        Qt::QueuedConnection);
  });
}

}  // namespace volumen
