#pragma once

#include <optional>

#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

/// Makes what segments are drawn by in 3D, of the series in 3D views on screen, whenever their voxels, or
/// what is taken away of the series, changed: a map at a time, as a job. Until then the session keeps what
/// was there before.
class SegmentSurfaceJobs : public QObject {
  Q_OBJECT
 public:
  SegmentSurfaceJobs(Session& session, Jobs& jobs, QObject* parent = nullptr);

 Q_SIGNALS:
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);

 private:
  // What is left of a series by a mask.
  struct Kept {
    SeriesKey series;
    Mask mask;
    std::shared_ptr<const BitMask> voxels;
  };
  // The surfaces of a map that are to be made, as yet without their fields.
  struct Wanted {
    std::vector<MadeSurface> surfaces;
    std::vector<MadeSurface>
        before;                // of each the last one with the same mask; without a field: there is none
    std::optional<Kept> kept;  // where there is a mask; without voxels: they are to be found
    VolumePtr whole;           // to find them in
  };
  struct Made {
    std::vector<MadeSurface> surfaces;
    std::optional<Kept> kept;
  };

  void next();
  Wanted wantedOf(const SegmentMap& map) const;
  void begin(const Wanted& wanted);
  void giveUp(std::vector<MadeSurface> surfaces);
  static Result<Made> made(const Wanted& wanted, const CancelToken& cancel);

  Session& session_;
  std::optional<Kept> kept_;  // of the last series with a mask
  JobLane lane_;
};

}  // namespace volumen
