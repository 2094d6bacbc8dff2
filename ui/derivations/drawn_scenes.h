#pragma once

#include <set>
#include <vector>

#include "ui/derivations/surfaces.h"
#include "ui/derivations/tissue_left.h"

namespace volumen {

/// What 3D views draw: scenes with the surfaces of segments, and series without the tissue that is left out.
/// Surfaces and volumes follow from the session. Until a new one is ready, the one before is drawn.
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
  /// Returns that volume with its inputs; null if Session::seriesOf() is drawn.
  const TissueLeft::Entry* tissue(ViewId view) const;
  /// Returns the segments drawn in a 3D view. They have a surface, of their present labels or of those before
  /// the last change.
  std::vector<SegmentInScene> segments(ViewId view) const;
  /// Returns those of them whose surface could not be made of their present labels.
  std::vector<SegmentNotDrawn> segmentsNotDrawn(ViewId view) const;

  const SurfaceFields& surfaces() const { return surfaces_; }
  const TissueLeft& tissues() const { return tissues_; }

  /// Reports that a series was drawn unchanged. Only then is the table of a CT removed, so that the first
  /// picture does not wait.
  void noteDrawn(const SeriesKey& series);

 Q_SIGNALS:
  /// Some view has something else to draw.
  void changed();
  /// A sentence; not sent for cancelled work.
  void failed(const QString& sentence);
  /// The user cancelled: a sentence.
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
