#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// A scene at the limits of numerical range and precision. Pictures are tiny, so that every method can draw
/// each case.
struct HardCase {
  std::string name = {};  ///< says why the case is hard
  VolumePtr volume = {};
  Scene scene = {};
  glm::ivec2 size{12, 12};
  /// Closed form of a pixel (premultiplied, 0..1), if there is one. Its argument is the length in mm of the
  /// ray inside box and clip. It is not called for empty rays.
  std::function<glm::dvec4(double lengthMm)> closedForm = {};
  /// True if matter is the same everywhere. The closed form then holds for every step length, not only in the
  /// limit.
  bool uniform = false;
  /// Why no level's error is promised here; null if one is.
  const char* finiteOnly = nullptr;
  /// Compared on every CPU target by default. Other cases need VOLUMEN_ALL_TARGETS for that.
  bool delicate = false;
};

/// The list to which each part of the cases is added.
class HardCases {
 public:
  HardCase& add(HardCase hardCase) { return all_.emplace_back(std::move(hardCase)); }
  /// Adds the case, whose camera is parallel, and its perspective twin.
  void addBoth(const HardCase& hardCase);
  const std::vector<HardCase>& all() const { return all_; }

 private:
  std::vector<HardCase> all_;
};

void addVolumeCases(HardCases& cases);
void addMatterCases(HardCases& cases);
void addCurveCases(HardCases& cases);
void addLightCases(HardCases& cases);
void addViewCases(HardCases& cases);

/// Returns all hard cases.
const std::vector<HardCase>& hardCases();

/// Returns the length in mm of the part of a pixel's ray inside box, clip box and planes (picture.md 6, 7).
/// Parts behind the eye do not count; 0 if nothing is left. Shares no code with the viewer's rooms.
double lengthOfRay(const Scene& scene, const VoxelGeometry& geometry, glm::ivec2 size, int px, int py);

/// Returns a scene in parallel projection along `direction`, lit by the headlight, with the whole box in
/// view.
Scene sceneOf(const Volume& volume, std::vector<CurvePoint> points, glm::dvec3 direction = {-0.5, 0.7, -0.4});
/// Returns a curve that is translucent at low values and gets denser upwards. Opacities are per voxel, values
/// are shares of low .. high.
std::vector<CurvePoint> softCurve(double low, double high);
/// Returns the same curve with two steps, for surfaces.
std::vector<CurvePoint> steppedCurve(double low, double high);

/// Returns a field of soft blobs in 0 .. 1, too fine to have any symmetry.
double waves(glm::dvec3 x);
/// Returns 1000 waves as floats on a grid of 20 x 18 x 16 voxels of 0.8 x 1 x 1.25 mm.
VolumePtr wavesVolume();
/// Returns 100 y on 20^3 voxels of 1 mm. Seen along y, its normal faces the viewer.
VolumePtr rampVolume();

}  // namespace volumen::tests
