#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/volume/occupancy_field.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The scene of picture.md as a plain value, with the defaults of picture.md 8.

/// The projection of rays: index into the table of modes (modes.h).
enum class Mode { composite, mip, minip, average };

/// One point of the transfer function (picture.md 4). `value` is in real units; colour and opacity are 0..1.
struct CurvePoint {
  float value = 0;
  glm::dvec3 colour{1};
  double opacity = 0;  ///< Per unitDistance mm
  bool operator==(const CurvePoint&) const = default;
};

/// One point of the gradient opacity: factor 0..1 at |g_p| = gradient (value per mm).
struct GradientOpacityPoint {
  double gradient = 0, factor = 1;
  bool operator==(const GradientOpacityPoint&) const = default;
};

struct TransferFunction {
  double unitDistance = 1.0;  ///< Unit distance in mm
  std::vector<CurvePoint> points{{150, {0.9, 0.8, 0.7}, 0.0}, {400, {1.0, 1.0, 0.9}, 0.8}};
  std::vector<GradientOpacityPoint> gradientOpacity;  ///< If empty, the factor is 1
  bool operator==(const TransferFunction&) const = default;
};

struct Shading {
  bool lit = true;
  int sides = 2;  ///< 1 or 2
  bool localViewer = false;
  std::optional<double> gradientFloor;  ///< Value per mm; if empty, the default of picture.md 5
  double ambient = 0.2, diffuse = 0.7, specular = 0.2, shininess = 20;
  bool operator==(const Shading&) const = default;
};

enum class Space { camera, patient };

struct Light {
  glm::dvec3 direction{0, 0, 1};  ///< Towards the light; any length
  Space space = Space::camera;
  glm::dvec3 colour{1};
  double intensity = 1.0;
  bool on = true;
  bool operator==(const Light&) const = default;
};

enum class Projection { parallel, perspective };

/// The camera of picture.md 7. `direction` and `up` may have any length.
struct Camera {
  std::optional<glm::dvec3> target;  ///< Patient space, mm; if empty, the centre of the volume
  glm::dvec3 direction{0, 1, 0}, up{0, 0, 1};
  Projection projection = Projection::parallel;
  double height = 300;    ///< Height of the view in mm, for parallel
  double fov = 30;        ///< Vertical angle in degrees, for perspective
  double distance = 800;  ///< Distance from eye to target in mm, for perspective
  bool operator==(const Camera&) const = default;
};

/// Keeps the half-space normal . p <= offset (patient space, mm). The normal may have any length; offset is
/// in mm along the unit normal.
struct ClipPlane {
  glm::dvec3 normal{0, 0, 1};
  double offset = 0;
  bool operator==(const ClipPlane&) const = default;
};

struct Clip {
  glm::dvec3 boxLow{0}, boxHigh{1};  ///< Fractions of the volume's box along i, j, k
  std::vector<ClipPlane> planes;
  bool operator==(const Clip&) const = default;
};

struct Background {
  bool transparent = false;
  glm::dvec3 colour{0};  ///< Ignored if transparent
  bool operator==(const Background& o) const {
    return transparent == o.transparent && (transparent || colour == o.colour);
  }
};

/// A segment drawn as a lit surface (picture.md 10) where its smoothed occupancy is 1/2.
struct SegmentSurface {
  /// Immutable and never null, on any grid; compared by identity.
  std::shared_ptr<const OccupancyField> field;
  glm::dvec3 colour{1};
  double opacity = 1;  ///< Opacity of one crossing of the surface; at 0 it is not drawn
  bool operator==(const SegmentSurface&) const = default;
};

struct Scene {
  Mode mode = Mode::composite;
  std::optional<Window> window;  ///< If empty, the file's, else P0.1 .. P99.9
  TransferFunction transferFunction;
  Shading shading;
  std::vector<Light> lights{Light{}};
  std::optional<Camera> camera;  ///< If empty, from the front with the whole box in view
  Clip clip;
  Background background;
  /// Sessions hold them; scene files have none.
  std::vector<SegmentSurface> segments;
  bool operator==(const Scene&) const = default;
};

/// Returns the visible segments, those with opacity and voxels. The pointers refer to `scene`.
std::vector<const SegmentSurface*> shownSegments(const Scene& scene);

/// Returns one of the six views of design.md 10 (anterior, posterior, left, right, superior, inferior); empty
/// if the name is unknown.
std::optional<Camera> standardView(const std::string& name);
/// Returns their names in that order.
const std::vector<std::string>& standardViewNames();

/// Returns `camera` with its target set, by default to the volume's centre. Height (parallel) and distance
/// (perspective, at its fov) are the smallest that fit the whole unclipped box into a picture of this aspect
/// (width / height).
Camera fitCamera(Camera camera, const VoxelGeometry& geometry, double aspect);

/// Orthonormal camera axes of picture.md 7 in patient space.
struct CameraAxes {
  glm::dvec3 right, up, direction;
};
CameraAxes cameraAxes(const Camera& camera);

/// Rotates the camera by `degrees` around its `up` through the target, anticlockwise seen from the tip of up
/// (design.md 10).
Camera turned(Camera camera, double degrees);

/// Sets the elevation of the eye to `degrees` above the plane through the target perpendicular to `up`
/// (towards its tip; -90 < degrees < 90), on the same side.
Camera elevated(Camera camera, double degrees);

}  // namespace volumen
