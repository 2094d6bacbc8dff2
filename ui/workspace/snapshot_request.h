#pragma once

#include <QSize>
#include <memory>
#include <optional>
#include <vector>

#include "results/segments/segment_picture_text.h"
#include "results/series/loaded_series.h"
#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"
#include "viewer/segment/mask.h"

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

/// Time points that are drawn one after another by one scene. They are read for it.
struct SnapshotSteps {
  std::vector<std::shared_ptr<const Series>> series{};
  Mask mask{};                ///< what is cut away from each
  bool withoutTable = false;  ///< the patient alone is drawn, where there is a table
};

/// A snapshot, a turntable, or pictures of time points to be made.
struct SnapshotRequest {
  SnapshotSeen seen;
  QSize size;
  Quality quality = Quality::high;
  std::optional<Background> background;  ///< empty: the scene's
  Annotations shown;
  int pictures = 1;       ///< in a full turn about the camera's up axis
  SnapshotSteps steps{};  ///< if there are any, they are drawn instead of a turn
};

}  // namespace volumen
