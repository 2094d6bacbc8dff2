#pragma once

#include <optional>
#include <string>
#include <utility>

#include "ui/document/job_lane.h"
#include "viewer/volume/rigid.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// A volume and its frame of reference.
struct PlacedVolume {
  std::string frame;
  VolumePtr volume;
};

/// Registers volumes, one pair at a time, each as a job.
class RegistrationJobs : public QObject {
  Q_OBJECT
 public:
  explicit RegistrationJobs(Jobs& jobs, QObject* parent = nullptr);

  /// Registers a pair. Cancels another pair in progress.
  void start(const PlacedVolume& fixed, const PlacedVolume& moving);
  void cancel();
  /// Returns the frames of reference of the pair in progress, if any.
  const std::optional<std::pair<std::string, std::string>>& pair() const { return pair_; }

 Q_SIGNALS:
  /// `toFromFrom` maps the frame of reference `from` to `to`.
  void found(const std::string& from, const std::string& to, const volumen::Rigid& toFromFrom);
  /// A sentence; not sent for cancelled work.
  void failed(const QString& sentence);

 private:
  std::optional<std::pair<std::string, std::string>> pair_;
  JobLane lane_;
};

}  // namespace volumen
