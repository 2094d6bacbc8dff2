#pragma once

#include <QSize>
#include <QString>
#include <optional>

#include "ui/data/loaded_series.h"
#include "ui/workspace/segment_picture_text.h"
#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// What is written over a snapshot.
struct Annotations {
  bool letters = false;   ///< the patient's sides at the edges
  bool scaleBar = false;  ///< where one scale holds: parallel projection, calibrated
  bool patient = false;   ///< patient and series
  bool warnings = true;   ///< what changes what is seen
  bool operator==(const Annotations&) const = default;
};

/// What a snapshot is of: a 3D view at the moment that it is asked for.
struct SnapshotSeen {
  LoadedSeriesPtr series;
  Scene scene;  ///< with its camera
  SegmentsInPicture segments{};
  bool namesHidden = false;
};

/// What a snapshot is to be.
struct SnapshotRequest {
  SnapshotSeen seen;
  /// PNG or JPEG by its suffix; of a turntable numbered before it, and with a further number where files of
  /// such names are there already; empty: the clipboard.
  QString path;
  QSize size;
  Quality quality = Quality::high;
  std::optional<Background> background;  ///< nothing: the scene's
  Annotations shown;
  int pictures = 1;  ///< of a full turn about the camera's up axis
};

}  // namespace volumen
