#pragma once

#include <QImage>

#include "io/study/series.h"
#include "ui/document/job_lane.h"

namespace volumen {

/// Returns a thumbnail centred in a transparent square of `edge` pixels.
QImage squareThumbnail(const QImage& thumbnail, int edge);

/// Makes square thumbnails of series on its own thread, one after another.
class Thumbnails : public QObject {
  Q_OBJECT
 public:
  explicit Thumbnails(int edge, QObject* parent = nullptr);

  /// Requests a thumbnail; ends in made(). There is none if the series cannot be read or is one large file
  /// that would have to be read whole.
  void request(const Series& series);
  /// Cancels all requests.
  void cancel() { lane_.giveUpAll(); }

 Q_SIGNALS:
  void made(const volumen::Series& series, const QImage& thumbnail);

 private:
  const int edge_;
  JobLane lane_{nullptr, QThread::LowPriority};
};

}  // namespace volumen
