#pragma once

#include "ui/data/loaded_frame.h"
#include "ui/workspace/workspace.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// The plane of a frame as its presentation state has it: turned, and made to fit what is displayed of it.
/// `acquired`: the plane of the same look without that. Only of frames with `how`.
SlicePlane presentedPlane(const LoadedFrame& frame, const FlatLook& look, SlicePlane acquired);

/// Where a position of an annotation lies, in the frame's mm. Only of frames with `how`.
glm::dvec3 annotationPlace(const LoadedFrame& frame, glm::dvec2 position, AnnotationUnits units);

/// The patient's side that a direction of the frame's plane points to, by the file's PatientOrientation:
/// letters as Frame has them; empty where the file does not say or the direction is none of rows and columns.
std::string frameSide(const LoadedFrame& frame, glm::dvec3 direction);

}  // namespace volumen
