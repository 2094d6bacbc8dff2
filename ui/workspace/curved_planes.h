#pragma once

#include "ui/workspace/workspace.h"

namespace volumen {

/// The two reformats of a series along one of its curves (CurvedKind).
struct CurvedPair {
  Series straightened, stretched;
};

/// Returns the reformats along a measured curve, `halfWidth` mm to each side. `towards` is the normal of the
/// plane it was drawn on and decides for straight curves. Stretched reformats across the patient begin on the
/// patient's right, and so do their straightened ones. Returns an Error if the curve lies on a frame, if its
/// series is missing, or that of curvedSeries().
Result<CurvedPair> curvedPair(const Workspace& workspace, const Measurement& curve, glm::dvec3 towards,
                              double halfWidth);

/// Returns `towards` for a curve if no view of its slices gives it: as in its earlier stretched reformat,
/// else the normal of its acquired slices.
glm::dvec3 usualTowards(const Workspace& workspace, const Measurement& curve);

/// Returns the curved reformats of a series without measurements, key images or segments.
std::vector<SeriesKey> unusedCurvesOf(const Workspace& workspace, const SeriesKey& source);

/// Shows four views: slices of the source, the straightened plane, the stretched plane and the
/// cross-sections. The slices are as seen on screen, `focus` first, else as acquired. Removes earlier
/// reformats along the curve unless they carry measurements, key images or segments.
Workspace withCurvedPlanes(Workspace workspace, const CurvedPair& pair);

/// Returns the selected curve, else the last curve on the series in focus, else null.
const Measurement* curveMeant(const Workspace& workspace);

}  // namespace volumen
