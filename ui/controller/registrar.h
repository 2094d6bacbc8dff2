#pragma once

#include <QObject>
#include <QThreadPool>
#include <QTimer>
#include <optional>
#include <string>
#include <utility>

#include "viewer/volume/cancel.h"
#include "viewer/volume/rigid.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// A volume and the frame of reference that it lies in.
struct PlacedVolume {
  std::string frame;
  VolumePtr volume;
};

/// Registers volumes on a worker thread, one pair at a time.
class Registrar : public QObject {
  Q_OBJECT
 public:
  explicit Registrar(QObject* parent = nullptr);
  /// Gives up what is under way.
  ~Registrar() override;

  /// Gives up another pair that is under way.
  void start(const PlacedVolume& fixed, const PlacedVolume& moving);
  void cancel();
  /// The frames of reference of the pair under way; none: nothing is.
  const std::optional<std::pair<std::string, std::string>>& pair() const { return pair_; }

 Q_SIGNALS:
  void begun();
  /// 0 to 1.
  void progressed(double part);
  /// From the one frame of reference to the other.
  void found(const std::string& from, const std::string& to, const volumen::Rigid& toFromFrom);
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);
  void ended();

 private:
  QThreadPool pool_;
  CancelToken cancel_;
  std::optional<std::pair<std::string, std::string>> pair_;
  QTimer watch_;
  int underWay_ = 0;
};

}  // namespace volumen
