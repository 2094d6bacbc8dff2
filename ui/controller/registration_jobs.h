#pragma once

#include <optional>
#include <string>
#include <utility>

#include "ui/document/job_lane.h"
#include "viewer/volume/rigid.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// A volume and the frame of reference that it lies in.
struct PlacedVolume {
  std::string frame;
  VolumePtr volume;
};

/// Registers volumes, one pair at a time, each a job.
class RegistrationJobs : public QObject {
  Q_OBJECT
 public:
  explicit RegistrationJobs(Jobs& jobs, QObject* parent = nullptr);

  /// Gives up another pair that is under way.
  void start(const PlacedVolume& fixed, const PlacedVolume& moving);
  void cancel();
  /// The frames of reference of the pair under way; none: nothing is.
  const std::optional<std::pair<std::string, std::string>>& pair() const { return pair_; }

 Q_SIGNALS:
  /// From the one frame of reference to the other.
  void found(const std::string& from, const std::string& to, const volumen::Rigid& toFromFrom);
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);

 private:
  std::optional<std::pair<std::string, std::string>> pair_;
  JobLane lane_;
};

}  // namespace volumen
