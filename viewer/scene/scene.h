#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/volume/occupancy_field.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The scene of picture.md as a plain value; every default is the one picture.md 8 shows.

/// What a ray shows: the row of this number in the table of modes (modes.h).
enum class Mode { composite, mip, minip, average };

/// One point of the transfer function (picture.md 4). `value` in real units, colour and opacity 0..1.
struct CurvePoint {
  float value = 0;
  glm::dvec3 colour{1};
  double opacity = 0;  ///< per unitDistance mm
  bool operator==(const CurvePoint&) const = default;
};

/// One point of the gradient opacity: factor 0..1 at |g_p| = gradient (value per mm).
struct GradientOpacityPoint {
  double gradient = 0, factor = 1;
  bool operator==(const GradientOpacityPoint&) const = default;
};

struct TransferFunction {
  double unitDistance = 1.0;  ///< mm
  std::vector<CurvePoint> points{{150, {0.9, 0.8, 0.7}, 0.0}, {400, {1.0, 1.0, 0.9}, 0.8}};
  std::vector<GradientOpacityPoint> gradientOpacity;  ///< empty: factor 1
  bool operator==(const TransferFunction&) const = default;
};

struct Shading {
  bool lit = true;
  int sides = 2;  ///< 1 or 2
  bool localViewer = false;
  std::optional<double> gradientFloor;  ///< value per mm; none: the default of picture.md 5
  double ambient = 0.2, diffuse = 0.7, specular = 0.2, shininess = 20;
  bool operator==(const Shading&) const = default;
};

enum class Space { camera, patient };

struct Light {
  glm::dvec3 direction{0, 0, 1};  ///< towards the light; need not be unit
  Space space = Space::camera;
  glm::dvec3 colour{1};
  double intensity = 1.0;
  bool on = true;
  bool operator==(const Light&) const = default;
};

enum class Projection { parallel, perspective };

/// picture.md 7. `direction` and `up` need not be unit.
struct Camera {
  std::optional<glm::dvec3> target;  ///< patient mm; none: the centre of the volume
  glm::dvec3 direction{0, 1, 0}, up{0, 0, 1};
  Projection projection = Projection::parallel;
  double height = 300;    ///< mm, parallel
  double fov = 30;        ///< degrees, vertical, perspective
  double distance = 800;  ///< mm from eye to target, perspective
  bool operator==(const Camera&) const = default;
};

/// Keeps normal . p <= offset (patient mm). The normal need not be unit; offset is in mm along the unit
/// normal.
struct ClipPlane {
  glm::dvec3 normal{0, 0, 1};
  double offset = 0;
  bool operator==(const ClipPlane&) const = default;
};

struct Clip {
  glm::dvec3 boxLow{0}, boxHigh{1};  ///< fractions of the volume's box along i, j, k
  std::vector<ClipPlane> planes;
  bool operator==(const Clip&) const = default;
};

struct Background {
  bool transparent = false;
  glm::dvec3 colour{0};  ///< no meaning where transparent
  bool operator==(const Background& o) const {
    return transparent == o.transparent && (transparent || colour == o.colour);
  }
};

/// A segment drawn as a lit surface of its own (picture.md 10): where its smoothed occupancy is 1/2.
struct SegmentSurface {
  std::shared_ptr<const OccupancyField> field;  ///< never null; of any grid; equal where it is the same
                                                ///< object: it never changes
  glm::dvec3 colour{1};
  double opacity = 1;  ///< of each crossing of the surface; 0: not drawn
  bool operator==(const SegmentSurface&) const = default;
};

struct Scene {
  Mode mode = Mode::composite;
  std::optional<Window> window;  ///< none: the file's, else P0.1 .. P99.9
  TransferFunction transferFunction;
  Shading shading;
  std::vector<Light> lights{Light{}};
  std::optional<Camera> camera;  ///< none: from the front, the whole box in view
  Clip clip;
  Background background;
  /// Of which none are in scene files: a session holds them.
  std::vector<SegmentSurface> segments;
  bool operator==(const Scene&) const = default;
};

/// The segments that show: opacity above 0, and not of no voxels. Pointers into `scene`.
std::vector<const SegmentSurface*> shownSegments(const Scene& scene);

/// The six views of design.md 10: anterior, posterior, left, right, superior, inferior. None where the name
/// is unknown.
std::optional<Camera> standardView(const std::string& name);
/// Their names, in that order.
const std::vector<std::string>& standardViewNames();

/// `camera` with its target set (the volume's centre where it has none) and with the smallest height
/// (parallel) and distance (perspective, at its fov) at which the volume's whole unclipped box fits in both
/// directions of a picture of this aspect (width / height).
Camera fitCamera(Camera camera, const VoxelGeometry& geometry, double aspect);

/// picture.md 7's orthonormal axes of a camera in patient space.
struct CameraAxes {
  glm::dvec3 right, up, direction;
};
CameraAxes cameraAxes(const Camera& camera);

/// `camera` turned by `degrees` about its `up` through the target, anticlockwise seen from the tip of up
/// (design.md 10).
Camera turned(Camera camera, double degrees);

/// `camera` with its eye `degrees` above the plane through the target at right angles to `up` (towards the
/// tip of up; -90 < degrees < 90), on the side where it was.
Camera elevated(Camera camera, double degrees);

}  // namespace volumen
