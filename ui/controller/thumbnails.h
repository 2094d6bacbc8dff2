#pragma once

#include <QImage>

#include "io/study/series.h"
#include "ui/document/job_lane.h"

namespace volumen {

/// In the middle of a square of `edge` pixels, transparent where the thumbnail does not fill it.
QImage squareThumbnail(const QImage& thumbnail, int edge);

/// Makes square thumbnails of series on a thread of its own, one after the other.
class Thumbnails : public QObject {
  Q_OBJECT
 public:
  explicit Thumbnails(int edge, QObject* parent = nullptr);

  /// Ends in made(), but where the series cannot be read or is one large file that would have to be read
  /// whole.
  void request(const Series& series);
  /// Forgets all requests.
  void cancel() { lane_.giveUpAll(); }

 Q_SIGNALS:
  void made(const volumen::Series& series, const QImage& thumbnail);

 private:
  const int edge_;
  JobLane lane_{nullptr, QThread::LowPriority};
};

}  // namespace volumen
