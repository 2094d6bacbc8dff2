#pragma once

#include <optional>
#include <string>
#include <vector>

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
  std::vector<SegmentMap> segments;  ///< all maps of the series; none: the view shows none
  std::optional<Quality> quality;    ///< none: the window chose it by time or error
};

/// Reads a session and finds the series of that view. The Error names the file, and the series where it is
/// missing or has changed.
Result<SessionView> readSessionView(const std::string& path, const CancelToken& cancel);

}  // namespace volumen
