#pragma once

#include <optional>
#include <string>

#include "io/study/series.h"
#include "ui/workspace/segment_map.h"
#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"
#include "viewer/segment/mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// What the 3D view in focus of a session shows.
struct SessionView {
  Series series;
  Mask mask;
  Scene scene;
  std::optional<SegmentMap> segments;  ///< of the series; none: it has none, or the view shows none
  std::optional<Quality> quality;      ///< none: the window chose it by time or error
};

/// Reads a session and finds the series of that view. The Error names the file, and the series where it is
/// missing or has changed.
Result<SessionView> readSessionView(const std::string& path, const CancelToken& cancel);

}  // namespace volumen
