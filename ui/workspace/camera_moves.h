#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "viewer/scene/scene.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Camera movements by hand, each from camera value to camera value. Cameras have a target. Pictures are
/// `size` pixels; positions in them are pixels, y down. Lengths are mm, angles rad.

/// Returns the camera that draws the scene: its own, or the one fitted to the volume in a picture of `size`.
Camera cameraInUse(const Scene& scene, const VoxelGeometry& geometry, glm::dvec2 size);

/// A line of sight (picture.md 7). In parallel projection the origin lies in the target's plane.
struct SightLine {
  glm::dvec3 origin, direction;  ///< patient space; `direction` is a unit vector
};
SightLine sightLine(const Camera& camera, glm::dvec2 size, glm::dvec2 position);

/// Returns the pixel position of a point in patient space. In perspective it must lie in front of the eye.
glm::dvec2 seenAt(const Camera& camera, glm::dvec2 size, glm::dvec3 pPatient);
/// Returns the lasso that cuts away the inside of an outline in the picture.
Lasso lassoOf(const Camera& camera, glm::dvec2 size, const std::vector<glm::dvec2>& outline);
/// Returns the size of a pixel in mm at a point.
double mmPerPixel(const Camera& camera, glm::dvec2 size, glm::dvec3 pPatient);

/// Turns the camera about `pivot` as on a turntable: by `turn` about the patient's z axis, by `tilt` about
/// the picture's horizontal. Positive angles move the near side right and down.
Camera orbited(Camera camera, glm::dvec3 pivot, double turn, double tilt);
/// Rolls about the line of sight through the target. Positive angles turn the picture clockwise.
Camera rolled(Camera camera, double angle);
/// Pans so that the point `at` follows the hand by `moved` pixels.
Camera panned(Camera camera, glm::dvec2 size, glm::dvec2 moved, glm::dvec3 at);
/// Zooms while `fixed` keeps its position in the picture. A factor below 1 enlarges.
Camera zoomedAt(Camera camera, glm::dvec3 fixed, double factor);
/// Changes the projection. Objects at the target's depth keep their size.
Camera withProjection(Camera camera, Projection projection);

/// Returns the patient's sides a direction points to, strongest first (LPS): "L", "PL", "SAR".
std::string sideLetters(glm::dvec3 direction);
/// Returns the same in words: "posterior-left".
std::string sideWords(glm::dvec3 direction);
/// Returns the height of the picture at the target's depth, in mm.
double heightAtTarget(const Camera& camera);
/// Returns the standard view within one degree of the line of sight, such as "anterior", else an empty
/// string.
std::string viewName(const Camera& camera);

}  // namespace volumen
