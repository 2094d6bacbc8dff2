#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// A scene at the edge of what numbers bear. Pictures are tiny, so that every method can be tried on each.
struct HardCase {
  std::string name = {};  ///< what is hard about it
  VolumePtr volume = {};
  Scene scene = {};
  glm::ivec2 size{12, 12};
  /// Where the picture has a closed form: the pixel (premultiplied, 0..1) of a ray of that length in mm
  /// inside the box and the clip; not called where that is empty.
  std::function<glm::dvec4(double lengthMm)> closedForm = {};
  /// The closed form holds at every length of step (matter is the same everywhere), not in the limit alone.
  bool uniform = false;
  /// Why no level's error is promised here, where none is.
  const char* finiteOnly = nullptr;
  /// Compared on every CPU target by default (the others only where VOLUMEN_ALL_TARGETS is set).
  bool delicate = false;
};

/// The list that a part of the cases is added to.
class HardCases {
 public:
  HardCase& add(HardCase hardCase) { return all_.emplace_back(std::move(hardCase)); }
  /// The case, whose camera is parallel, and its twin in perspective.
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

/// All of them.
const std::vector<HardCase>& hardCases();

/// The length in mm of the ray through a pixel inside box, clip box and planes and in front of the eye
/// (picture.md 6, 7); 0 where it is empty. Shares no code with the viewer's rooms.
double lengthOfRay(const Scene& scene, const VoxelGeometry& geometry, glm::ivec2 size, int px, int py);

/// A scene seen from `direction` in parallel, the whole box in view, lit by the headlight.
Scene sceneOf(const Volume& volume, std::vector<CurvePoint> points, glm::dvec3 direction = {-0.5, 0.7, -0.4});
/// Translucent below, denser and denser above; opacities per voxel, values as shares of low .. high.
std::vector<CurvePoint> softCurve(double low, double high);
/// The same with two steps, for surfaces.
std::vector<CurvePoint> steppedCurve(double low, double high);

/// Soft blobs, their grain too fine for any symmetry: 0 .. 1.
double waves(glm::dvec3 x);
/// 1000 waves on a grid of 20 x 18 x 16 voxels of 0.8 x 1 x 1.25 mm, as floats.
VolumePtr wavesVolume();
/// 100 y on 20^3 voxels of 1 mm: seen along y its normal looks at the viewer.
VolumePtr rampVolume();

}  // namespace volumen::tests
