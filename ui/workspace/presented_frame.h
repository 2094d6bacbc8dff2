#pragma once

#include "results/series/loaded_frame.h"
#include "ui/workspace/workspace.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// Returns the plane of a frame as its presentation state shows it: turned, and fitted to the displayed area.
/// `acquired` is the plane of the same look without the state. Only for frames with `how`.
SlicePlane presentedPlane(const LoadedFrame& frame, const FlatLook& look, SlicePlane acquired);

/// Returns an annotation's position in the frame's mm. Only for frames with `how`.
glm::dvec3 annotationPlace(const LoadedFrame& frame, glm::dvec2 position, AnnotationUnits units);

/// Returns the patient's side that a direction of the frame's plane points to, in letters as Frame has them,
/// by the file's PatientOrientation. Empty if the file gives none, or the direction follows neither rows nor
/// columns.
std::string frameSide(const LoadedFrame& frame, glm::dvec3 direction);

}  // namespace volumen
