#pragma once

#include <QImage>
#include <QTimer>
#include <vector>

#include "io/study/series.h"
#include "ui/controller/frame_service.h"
#include "ui/document/job_lane.h"

namespace volumen {

/// Returns a thumbnail centred in a transparent square of `edge` pixels.
QImage squareThumbnail(const QImage& thumbnail, int edge);

/// Makes square thumbnails of series on its own thread, one after another. Frames that views wait for come
/// first. Large frames that they hold are not read again.
class Thumbnails : public QObject {
  Q_OBJECT
 public:
  Thumbnails(int edge, FrameService& frames, QObject* parent = nullptr);

  /// Requests a thumbnail; ends in made(). There is none if the series cannot be read or is one large file
  /// that would have to be read whole.
  void request(const Series& series);
  /// Cancels all requests.
  void cancel();

 Q_SIGNALS:
  void made(const volumen::Series& series, const QImage& thumbnail);

 private:
  void begin();

  const int edge_;
  FrameService& frames_;
  std::vector<Series> requested_;  // not begun
  QTimer soon_;
  JobLane lane_{nullptr, QThread::LowPriority};
};

}  // namespace volumen
