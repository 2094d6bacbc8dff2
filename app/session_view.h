#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/study/series.h"
#include "results/segments/segment_map.h"
#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"
#include "viewer/segment/mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The contents of the focused 3D view of a session.
struct SessionView {
  Series series;
  Mask mask;
  Scene scene;
  std::vector<SegmentMap> segments;  ///< all maps of the series; empty if the view shows none
  std::optional<Quality> quality;    ///< empty if the window chose it by time or error
};

/// Reads a session and finds the series of its focused 3D view. The Error names the file, and the series if
/// it is missing or has changed.
Result<SessionView> readSessionView(const std::string& path, const CancelToken& cancel);

/// Returns whether the view masks the volume of its series by segments.
bool showsTissueApart(const SessionView& session, const Volume& volume);
/// Returns the volume with air where that mask hides it. The Error: cancelled, or too little memory.
Result<VolumePtr> tissueAlone(const SessionView& session, const Volume& volume, const CancelToken& cancel);

}  // namespace volumen
