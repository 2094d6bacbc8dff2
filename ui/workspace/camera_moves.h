#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "viewer/scene/scene.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Moves of a camera by hand, from value to value. Cameras have a target; pictures are `size` pixels,
/// positions in them in pixels, y downwards. All lengths mm, all angles rad.

/// The camera that draws the scene: its own, or the one fitted to the volume in a picture of this size.
Camera cameraInUse(const Scene& scene, const VoxelGeometry& geometry, glm::dvec2 size);

/// A line of sight (picture.md 7). parallel: the origin lies in the plane of the target.
struct SightLine {
  glm::dvec3 origin, direction;  ///< patient space; direction is a unit vector
};
SightLine sightLine(const Camera& camera, glm::dvec2 size, glm::dvec2 position);

/// Where a point in patient space is seen. For perspective it must lie in front of the eye.
glm::dvec2 seenAt(const Camera& camera, glm::dvec2 size, glm::dvec3 pPatient);
/// An outline in the picture as what it cuts; what is inside goes.
Lasso lassoOf(const Camera& camera, glm::dvec2 size, const std::vector<glm::dvec2>& outline);
/// Millimetres a pixel covers at that point.
double mmPerPixel(const Camera& camera, glm::dvec2 size, glm::dvec3 pPatient);

/// Turned by `turn` about the patient's z axis and by `tilt` about the picture's horizontal, through `pivot`:
/// a turntable. Positive angles move what is in front to the right and down.
Camera orbited(Camera camera, glm::dvec3 pivot, double turn, double tilt);
/// Rolled about the line of sight through the target; positive: the picture turns clockwise.
Camera rolled(Camera camera, double angle);
/// Moved so that `at` follows the hand by `moved` pixels.
Camera panned(Camera camera, glm::dvec2 size, glm::dvec2 moved, glm::dvec3 at);
/// Zoomed, `fixed` staying where it is; factor < 1 enlarges.
Camera zoomedAt(Camera camera, glm::dvec3 fixed, double factor);
/// The other projection, what is at the target's depth as large as before.
Camera withProjection(Camera camera, Projection projection);

/// The patient's side a direction points to: "L", "PL", "SAR" ..., strongest first (LPS).
std::string sideLetters(glm::dvec3 direction);
/// The same in words: "posterior-left".
std::string sideWords(glm::dvec3 direction);
/// Millimetres from the lower to the upper edge of the picture, at the target's depth.
double heightAtTarget(const Camera& camera);
/// "anterior" where the camera looks along that view within a degree, else empty.
std::string viewName(const Camera& camera);

}  // namespace volumen
