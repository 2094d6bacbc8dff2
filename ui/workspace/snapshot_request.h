#pragma once

#include <QSize>
#include <optional>

#include "results/segments/segment_picture_text.h"
#include "results/series/loaded_series.h"
#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// The annotations of a snapshot.
struct Annotations {
  bool letters = false;   ///< the patient's sides at the edges
  bool scaleBar = false;  ///< only if one scale holds: parallel projection, calibrated
  bool patient = false;   ///< patient and series
  bool warnings = true;   ///< warnings about what is seen
  bool operator==(const Annotations&) const = default;
};

/// The subject of a snapshot: a 3D view at the moment of the request.
struct SnapshotSeen {
  LoadedSeriesPtr series;
  Scene scene;  ///< with its camera
  SegmentsInPicture segments{};
  bool namesHidden = false;
};

/// A snapshot or turntable to be made.
struct SnapshotRequest {
  SnapshotSeen seen;
  QSize size;
  Quality quality = Quality::high;
  std::optional<Background> background;  ///< empty: the scene's
  Annotations shown;
  int pictures = 1;  ///< in a full turn about the camera's up axis
};

}  // namespace volumen
