#pragma once

#include <optional>
#include <set>
#include <utility>

#include "ui/controller/segment_fields.h"
#include "ui/controller/segment_painter.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

/// Makes what segments are drawn by in 3D, of the series in 3D views on screen, whenever their voxels, or
/// what is taken away of the series, changed: a map at a time, as a job; of a stroke once it ends, and none
/// of one that is given up. Until then the session keeps what was there before. What could not be made, or
/// was cancelled, is tried again once anything of the segments of its series changes. All of them together
/// take at most a share of the machine's memory: what would go beyond is not drawn. Those of hidden segments
/// are kept while there is room.
class SegmentSurfaceJobs : public QObject {
  Q_OBJECT
 public:
  /// `mostBytes`: of the fields of all surfaces.
  SegmentSurfaceJobs(Session& session, const SegmentPainter& painter, Jobs& jobs,
                     std::size_t mostBytes = mostSurfaceBytes(), QObject* parent = nullptr);

 Q_SIGNALS:
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);
  /// The user did: a sentence.
  void cancelled(const QString& sentence);

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
        before;                 // of each the last one with the same mask; without a field: there is none
    std::optional<Kept> kept;   // where there is a mask; without voxels: they are to be found
    VolumePtr whole;            // to find them in
    std::size_t mostBytes = 0;  // beside other surfaces
  };
  struct Made {
    std::vector<MadeSurface> surfaces;
    std::optional<Kept> kept;
  };

  void noteChanges(const Workspace& before, const Workspace& after);
  void next();
  bool isInVain() const;
  Wanted wantedOf(const SegmentMap& map) const;
  void begin(const Wanted& wanted);
  std::size_t bytesBeside(const std::vector<MadeSurface>& wanted) const;
  void tryAgain(const Wanted& wanted);
  void tellRefused(const Wanted& wanted, const std::vector<MadeSurface>& made);
  void giveUp(std::vector<MadeSurface> surfaces, const QString& why);
  static Result<Made> made(const Wanted& wanted, const CancelToken& cancel);

  Session& session_;
  const SegmentPainter& painter_;
  const std::size_t mostBytes_;
  std::optional<Kept> kept_;  // of the last series with a mask
  // Maps, by their numbers, of whose series something was changed since surfaces of them were given up.
  std::set<std::pair<SeriesKey, int>> again_;
  MadeSurface underWay_;  // the first that the last job was to make
  JobLane lane_;
};

}  // namespace volumen
