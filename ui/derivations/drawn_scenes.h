#pragma once

#include <set>
#include <vector>

#include "ui/derivations/surfaces.h"
#include "ui/derivations/tissue_left.h"

namespace volumen {

/// Combines what 3D views draw: scenes with surfaces of segments, and series without masked tissue. Surfaces
/// and volumes are derived from the session. The old ones are drawn until the new ones are ready.
class DrawnScenes : public QObject {
  Q_OBJECT
 public:
  /// `mostBytes` limits the fields of all surfaces.
  DrawnScenes(const Session& session, const SegmentPainter& painter, Jobs& jobs,
              std::size_t mostBytes = mostSurfaceBytes());

  /// Returns the scene of a view with the surfaces of segments().
  Scene scene(ViewId view) const;
  /// Returns the series of a 3D view with air where tissue is left out. Null if Session::seriesOf() is.
  LoadedSeriesPtr series(ViewId view) const;
  /// Returns the volume of series() with its inputs; null if Session::seriesOf() is drawn.
  const TissueLeft::Entry* tissue(ViewId view) const;
  /// Returns the segments drawn in a 3D view. They have a surface, of their present labels or of those before
  /// the last change.
  std::vector<SegmentInScene> segments(ViewId view) const;
  /// Returns the segments of a 3D view whose present labels have no surface, with the reasons.
  std::vector<SegmentNotDrawn> segmentsNotDrawn(ViewId view) const;

  const SurfaceFields& surfaces() const { return surfaces_; }
  const TissueLeft& tissues() const { return tissues_; }

  /// Reports that a series was drawn unchanged. Only then is the table of a CT removed, so that the first
  /// picture does not wait.
  void noteDrawn(const SeriesKey& series);

 Q_SIGNALS:
  /// A surface or volume of a 3D view was replaced or dropped.
  void changed();
  /// A sentence; not sent for cancelled work.
  void failed(const QString& sentence);
  /// The user cancelled the surfaces. The sentence says how to get them.
  void cancelled(const QString& sentence);

 private:
  void update();

  const Session& session_;
  std::set<SeriesKey> drawn_;
  KeptVoxels kept_;
  SurfaceFields surfaces_;
  TissueLeft tissues_;
};

}  // namespace volumen
