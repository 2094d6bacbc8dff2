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

/// Makes the surfaces of segments for series in 3D views on screen, when their voxels or the mask of the
/// series have changed. Each job makes the surfaces of one map. A stroke is included once it ends, and not at
/// all if it is cancelled. Until then the session keeps the old surfaces. Failed or cancelled surfaces are
/// retried when segments of the series change. All surfaces together use a limited share of memory; those
/// beyond it are not drawn. Surfaces of hidden segments are kept while there is room.
class SegmentSurfaceJobs : public QObject {
  Q_OBJECT
 public:
  /// `mostBytes` limits the fields of all surfaces.
  SegmentSurfaceJobs(Session& session, const SegmentPainter& painter, Jobs& jobs,
                     std::size_t mostBytes = mostSurfaceBytes(), QObject* parent = nullptr);

 Q_SIGNALS:
  /// A sentence; not sent for cancelled work.
  void failed(const QString& sentence);
  /// A sentence: the user cancelled.
  void cancelled(const QString& sentence);

 private:
  // The voxels of a series left by a mask.
  struct Kept {
    SeriesKey series;
    Mask mask;
    std::shared_ptr<const BitMask> voxels;
  };
  // The surfaces of a map to be made, without fields yet.
  struct Wanted {
    std::vector<MadeSurface> surfaces;
    std::vector<MadeSurface>
        // Last version of each with the same mask; without a field if there is none.
        before;
    std::optional<Kept> kept;   // set if there is a mask; its voxels are null until found
    VolumePtr whole;            // the volume to find them in
    std::size_t mostBytes = 0;  // left beside other surfaces
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
  // Maps, by number, of series whose segments have changed since surfaces were given up.
  std::set<std::pair<SeriesKey, int>> again_;
  MadeSurface underWay_;  // the first surface of the last job
  JobLane lane_;
};

}  // namespace volumen
